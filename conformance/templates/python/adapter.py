"""An adapter for the conformance cases, to start from: `dsr conform run -- python3 adapter.py`. Python 3.8 or later.

`Graph` is a small implementation: the last version of a vertex or edge wins. Put your own in its place; the rest speaks the
protocol, profile `observe`, and can stay. While replicas take turns the cases pass. Then they find `Graph` wanting, and
rightly so: of two writes on one vertex it loses one, and two moves can close a cycle."""
import json
import sys

# The members of objects: `?` may be missing, of `a|b` exactly one is there. All are texts but those of KINDS.
COMMANDS = {"hello": "protocols spec corpus", "case_begin": "case replicas", "mutate": "replica mutations",
            "deliver": "replica delta", "read": "replica"}
MUTATIONS = {"add_vertex": "as type name link attributes?", "add_edge": "from label to attributes?",
             "update_attributes": "vertex|edge attributes", "remove_edge": "from label to", "remove_vertex": "vertex",
             "move_edge": "old new attributes?"}
PARTS = {"link": "from|to label attributes?", "edge": "from label to", "old": "from label to", "new": "from label to"}
KINDS = {**dict.fromkeys(["attributes", *PARTS], dict), **dict.fromkeys(["protocols", "replicas", "mutations"], list)}

class Declined(Exception):
    """Why a request is not done: a message and a code."""
def check(holds, message, code="refused"):
    if not holds:
        raise Declined(message, code)
def fits(*texts):
    return all(1 <= len(text.encode()) <= 255 for text in texts)
def key(edge):
    return edge["from"], edge["label"], edge["to"]

# =========== YOUR IMPLEMENTATION GOES HERE. What is used of it is Graph(number), `mutate`, `join` and `view`. ===========
class Graph:
    """`held` has for each vertex (its handle) and each edge (from, label, to) its last version, behind that one's stamp."""
    def __init__(self, number, held={"root": ((0, 0), {"attributes": {}})}):
        self.number, self.held, self.delta = number, dict(held), {}
    def mutate(self, mutations):  # Makes all and returns their delta, or raises `Declined` and changes nothing.
        draft = Graph(self.number, self.held)
        for name, given in mutations:
            before = draft.stranded()
            getattr(draft, name)(given, given.get("attributes", {}))
            check(name[:3] in ("add", "upd") or draft.stranded() <= before, "somebody would lose path or parent")
        self.held = draft.held
        return draft.delta
    def join(self, delta):
        for element, new in delta.items():
            self.held[element] = max(self.held.get(element, new), new, key=lambda version: version[0])
    def view(self):
        edges = [dict(zip(("from", "label", "to"), edge), **self.held[edge][1]) for edge in self.edges()]
        vertices = {vertex: self.held[vertex][1] for vertex in self.vertices()}
        return {"root": vertices.pop("root"), "vertices": vertices, "edges": edges}
    def vertices(self):
        return {one for one, (_, version) in self.held.items() if version and isinstance(one, str)}
    def edges(self):
        there = {one for one, (_, version) in self.held.items() if version}
        return {one for one in there if not isinstance(one, str) and {one[0], one[2]} <= there}
    def stranded(self):  # Who has no path to the root, or a child but no parent.
        edges, reached, ahead = self.edges(), set(), {"root"}
        while not ahead <= reached:
            reached, ahead = reached | ahead, {end for e in edges if {e[0], e[2]} & ahead for end in (e[0], e[2])}
        parents, children = ({edge[at] for edge in edges if edge[1] == "RT"} for at in (0, 2))
        return self.vertices() - reached | parents - children - {"root"}
    def put(self, element, version, updates):  # The version of what is removed is empty.
        old, stamp = version.get("attributes", {}), (1 + max(at for (at, _), _ in self.held.values()), self.number)
        check(len(updates) <= 1024 and fits(*updates), "too many attributes, or a name does not fit")
        check(all(value or name in old for name, value in updates.items()), "what is to be unset is not set")
        attributes = {name: value for name, value in {**old, **updates}.items() if value}
        self.held[element] = self.delta[element] = (stamp, version and {**version, "attributes": attributes})
    def add_vertex(self, given, attributes):
        vertex, name, link = given["as"], given["name"], given["link"]
        taken = {"root", "world"} | {self.held[one][1].get("name") for one in self.vertices()}
        check(fits(given["type"], name) and name not in taken, "the type or the name does not fit, or the name is taken")
        check("from" in link or link["label"] != "RT", "a new vertex is nobody's parent")
        self.put(vertex, {"type": given["type"], "name": name}, attributes)
        self.add_edge({"from": vertex, "to": vertex, **link}, link.get("attributes", {}))
    def add_edge(self, given, attributes):
        (source, label, to), parents = key(given), {e[2]: e[0] for e in self.edges() if e[1] == "RT"}
        free = source != to and {source, to} <= self.vertices() and key(given) not in self.edges()
        check(free and fits(label), "the label or an end does not fit, or the edge is there already")
        above, tree = [source], {"root", *parents, *parents.values()}
        while above[-1] in parents and above[-1] not in above[:-1]:
            above.append(parents[above[-1]])
        check(label != "RT" or source in tree and to not in {"root", *parents, *above}, "the tree would be none")
        self.put(key(given), {"attributes": {}}, attributes)
    def update_attributes(self, given, updates):
        element = given["vertex"] if "vertex" in given else key(given["edge"])
        check(updates and element in self.vertices() | self.edges(), "the target is not there, or there is no update")
        self.put(element, self.held[element][1], updates)
    def remove_edge(self, given, _):
        check(key(given) in self.edges(), "the edge is not there")
        self.put(key(given), {}, {})
    def move_edge(self, given, attributes):
        check(given["old"] != given["new"], "the edge would stay where it is")
        self.remove_edge(given["old"], {})
        self.add_edge(given["new"], attributes)
    def remove_vertex(self, given, _):
        check(given["vertex"] in self.vertices() - {"root"}, "the vertex is the root, or not there")
        for element in [edge for edge in self.edges() if given["vertex"] in (edge[0], edge[2])] + [given["vertex"]]:
            self.put(element, {}, {})

class Adapter:
    replicas, deltas, handles = {}, {}, {"root"}  # Of a case; the handles are those that are bound.
    def hello(self, protocols, spec, corpus):
        check(1 in protocols, "this adapter speaks protocol 1", "unsupported")
        about = {"name": "my graph", "version": "0.1.0", "language": "Python", "source": "adapter.py"}
        return {"protocol": 1, "implementation": about, "profiles": ["observe"], "features": [],
                "limits": {"line_bytes": 1 << 20, "replicas": 64}}
    def case_begin(self, case, replicas):
        self.replicas = {name: Graph(number) for number, name in enumerate(replicas)}
        self.deltas, self.handles = {}, {"root"}
    def mutate(self, replica, mutations):
        bound, group = set(self.handles), [only(MUTATIONS, mutation) for mutation in mutations]
        for _, given in group:
            objects = [given, *(given[part] for part in PARTS if part in given)]
            ends = {one[end] for one in objects for end in ("from", "to", "vertex") if end in one}
            check(ends <= bound, f"one of {ends} is no vertex's handle", "unknown")
            check(given.get("as") not in bound, "the handle is bound already", "rejected_input")
            bound |= {given["as"]} if "as" in given else set()
        name = f"d{len(self.deltas)}"
        self.deltas[name], self.handles = known(self.replicas, replica).mutate(group), bound
        return {"delta": name}
    def deliver(self, replica, delta):
        known(self.replicas, replica).join(known(self.deltas, delta))
    def read(self, replica):
        return {"view": known(self.replicas, replica).view()}

def known(named, name):
    check(name in named, f"nobody has named {name!r}", "unknown")
    return named[name]
def shape(wanted, given):
    parts = [(part.rstrip("?").split("|"), "?" in part) for part in wanted.split()]
    right = isinstance(given, dict) and set(given) <= {name for names, _ in parts for name in names}
    right = right and all(len(set(names) & set(given)) in (1, 1 - optional) for names, optional in parts)
    check(right and all(isinstance(given[name], KINDS.get(name, str)) for name in given), f"not {wanted!r}", "rejected_input")
    any(shape(PARTS[name], given[name]) for name in PARTS if name in given)
def only(shapes, given, code="rejected_input"):
    check(isinstance(given, dict) and len(given) == 1, "not an object with one member", "rejected_input")
    [(name, value)] = given.items()
    check(name in shapes, f"{name!r} is not known", code)
    shape(shapes[name], value)
    return name, value

adapter, twice = Adapter(), []
for line in sys.stdin.buffer:
    twice.clear()  # What is left over where a key stands twice.
    request = json.loads(line.decode(), object_pairs_hook=lambda pairs: twice.extend(pairs[len(dict(pairs)):]) or dict(pairs))
    reply = {"id": request["id"]}  # What is no JSON, or has no id, has ended the conversation by now.
    try:
        check(not twice and set(request) == {"id", "do"}, "not {id, do}, or a key stands twice", "rejected_input")
        name, arguments = only(COMMANDS, request["do"], "unsupported")
        reply["ok"] = getattr(adapter, name)(**arguments) or {}
    except Declined as why:
        reply["error"] = dict(zip(("message", "code"), why.args))
    print(json.dumps(reply), flush=True)
