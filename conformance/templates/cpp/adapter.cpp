// An adapter for the conformance cases, to start from. C++17 and nlohmann/json (Debian: nlohmann-json3-dev):
// `make`, then `dsr conform run -- ./adapter`.
//
// `Graph` is a small implementation: the last version of a vertex or edge wins. Put your own in its place; the rest speaks the
// protocol (spec/conformance.md), profile `observe`, and can stay. While replicas take turns the cases pass. Then they find
// `Graph` wanting, and rightly so: of two writes on one vertex it loses one, and two moves can close a cycle.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using nlohmann::json;
using Text = std::string;

/// Why a request is not done.
struct Declined {
    Text code, message;
};

void check(bool holds, const Text& message, const Text& code = "refused") {
    if (!holds) throw Declined{code, message};
}

bool fits(const Text& text) { return text.size() >= 1 && text.size() <= 255; }

// ============ YOUR IMPLEMENTATION GOES HERE. What is used of it is Graph(number), Graph::Delta, mutate, join and view. ============

class Graph {
public:
    /// A vertex is its handle; an edge is from, label, to.
    using Element = std::vector<Text>;
    /// When and by whom: clock, replica.
    using Stamp = std::pair<std::uint64_t, std::size_t>;
    /// For each element its last version, behind that one's stamp; of what is removed it is null.
    using Delta = std::map<Element, std::pair<Stamp, json>>;
    using Group = std::vector<std::pair<Text, json>>;

    explicit Graph(std::size_t number) : number_(number) {
        held_[{"root"}] = {{0, 0}, json{{"attributes", json::object()}}};
    }

    /// Makes all mutations and returns their delta, or throws `Declined` and changes nothing.
    Delta mutate(const Group& group) {
        Graph draft = *this;
        draft.delta_.clear();
        for (const auto& [name, given] : group) {
            const auto before = draft.stranded();
            draft.make(name, given);
            if (name.rfind("remove", 0) != 0 && name.rfind("move", 0) != 0) continue;
            for (const auto& vertex : draft.stranded()) check(before.count(vertex) > 0, vertex + " would lose path or parent");
        }
        held_ = std::move(draft.held_);
        return draft.delta_;
    }

    /// Takes from a delta what is later than what is held.
    void join(const Delta& delta) {
        for (const auto& [element, version] : delta) {
            const auto [held, is_new] = held_.insert({element, version});
            if (!is_new && held->second.first < version.first) held->second = version;
        }
    }

    /// What a reader sees.
    json view() const {
        json vertices = json::object(), edges = json::array();
        for (const auto& vertex : vertices_shown()) {
            if (vertex != "root") vertices[vertex] = version({vertex});
        }
        for (const auto& edge : edges_shown()) {
            edges.push_back({{"from", edge[0]}, {"label", edge[1]}, {"to", edge[2]}, {"attributes", version(edge)["attributes"]}});
        }
        return {{"vertices", vertices}, {"edges", edges}, {"root", version({"root"})}};
    }

private:
    std::size_t number_;
    Delta held_, delta_;

    json version(const Element& element) const { return held_.at(element).second; }

    static Element key(const json& edge) { return {edge["from"], edge["label"], edge["to"]}; }

    static json attributes_of(const json& given) { return given.value("attributes", json::object()); }

    std::set<Text> vertices_shown() const {
        std::set<Text> shown;
        for (const auto& [element, held] : held_) {
            if (element.size() == 1 && !held.second.is_null()) shown.insert(element[0]);
        }
        return shown;
    }

    std::set<Element> edges_shown() const {
        const auto ends = vertices_shown();
        std::set<Element> shown;
        for (const auto& [element, held] : held_) {
            const bool is_edge = element.size() == 3 && !held.second.is_null();
            if (is_edge && ends.count(element[0]) && ends.count(element[2])) shown.insert(element);
        }
        return shown;
    }

    std::map<Text, Text> parents() const {
        std::map<Text, Text> found;
        for (const auto& edge : edges_shown()) {
            if (edge[1] == "RT") found[edge[2]] = edge[0];
        }
        return found;
    }

    static bool has_child(const std::map<Text, Text>& parents, const Text& vertex) {
        return std::any_of(parents.begin(), parents.end(), [&](const auto& pair) { return pair.second == vertex; });
    }

    /// Who has no path to the root, or a child but no parent.
    std::set<Text> stranded() const {
        const auto edges = edges_shown();
        const auto above = parents();
        std::set<Text> reached{"root"}, found;
        for (std::size_t before = 0; before != reached.size();) {
            before = reached.size();
            for (const auto& edge : edges) {
                if (reached.count(edge[0]) || reached.count(edge[2])) reached.insert({edge[0], edge[2]});
            }
        }
        for (const auto& vertex : vertices_shown()) {
            const bool is_detached = vertex != "root" && !above.count(vertex) && has_child(above, vertex);
            if (is_detached || !reached.count(vertex)) found.insert(vertex);
        }
        return found;
    }

    void make(const Text& name, const json& given) {
        if (name == "add_vertex") return add_vertex(given);
        if (name == "add_edge") return add_edge(key(given), attributes_of(given));
        if (name == "update_attributes") return update_attributes(given);
        if (name == "remove_edge") return remove_edge(key(given));
        if (name == "remove_vertex") return remove_vertex(given["vertex"]);
        check(given["old"] != given["new"], "the edge would stay where it is");
        remove_edge(key(given["old"]));
        add_edge(key(given["new"]), attributes_of(given));
    }

    /// Writes a version with the attributes of `version`, updated.
    void put(const Element& element, json version, const json& updates) {
        check(updates.size() <= 1024, "too many attributes");
        for (const auto& [name, value] : updates.items()) {
            check(fits(name), "the name of an attribute is empty or too long");
            json& attributes = version["attributes"];
            if (!value.is_null()) attributes[name] = value;
            else check(attributes.erase(name) == 1, "what is to be unset is not set");
        }
        Stamp stamp{0, number_};
        for (const auto& [_, held] : held_) stamp.first = std::max(stamp.first, held.first.first);
        ++stamp.first;
        held_[element] = delta_[element] = {stamp, std::move(version)};
    }

    void add_vertex(const json& given) {
        const Text vertex = given["as"], kind = given["type"], name = given["name"];
        const json& link = given["link"];
        check(fits(kind) && fits(name), "type or name is empty or too long");
        check(name != "root" && name != "world", "the name is reserved");
        for (const auto& other : vertices_shown()) {
            check(other == "root" || version({other})["name"] != name, "the name is taken");
        }
        check(link.contains("from") || link["label"] != "RT", "a new vertex is nobody's parent");
        put({vertex}, {{"type", kind}, {"name", name}, {"attributes", json::object()}}, attributes_of(given));
        add_edge({link.value("from", vertex), link["label"], link.value("to", vertex)}, attributes_of(link));
    }

    void add_edge(const Element& edge, const json& attributes) {
        const auto& [from, label, to] = std::tie(edge[0], edge[1], edge[2]);
        check(fits(label), "the label is empty or too long");
        const auto vertices = vertices_shown();
        check(vertices.count(from) && vertices.count(to), "an end is not in the graph");
        check(from != to, "both ends are the same");
        check(!edges_shown().count(edge), "the edge is there already");
        if (label == "RT") {
            const auto above = parents();
            check(to != "root" && !above.count(to), "the child is the root, or has a parent");
            check(from == "root" || above.count(from) || has_child(above, from), "the parent is not in the tree");
            std::set<Text> ancestors{from};
            for (auto up = above.find(from); up != above.end() && ancestors.insert(up->second).second;) up = above.find(up->second);
            check(!ancestors.count(to), "the child is above its parent");
        }
        put(edge, {{"attributes", json::object()}}, attributes);
    }

    void update_attributes(const json& given) {
        const bool is_vertex = given.contains("vertex");
        const Element element = is_vertex ? Element{given["vertex"]} : key(given["edge"]);
        const bool is_there = is_vertex ? vertices_shown().count(element[0]) : edges_shown().count(element);
        check(is_there, "the target is not in the graph");
        check(!given["attributes"].empty(), "no attribute is given");
        put(element, version(element), given["attributes"]);
    }

    void remove_edge(const Element& edge) {
        check(edges_shown().count(edge), "the edge is not in the graph");
        put(edge, nullptr, json::object());
    }

    void remove_vertex(const Text& vertex) {
        check(vertex != "root" && vertices_shown().count(vertex), "the vertex is the root, or not in the graph");
        for (const auto& edge : edges_shown()) {
            if (edge[0] == vertex || edge[2] == vertex) put(edge, nullptr, json::object());
        }
        put({vertex}, nullptr, json::object());
    }
};

// ============ From here on: the protocol. ============

using Shapes = std::map<Text, Text>;

// The members of objects: `?` may be missing, of `a|b` exactly one is there.
const Shapes COMMANDS{{"hello", "protocols spec corpus"}, {"case_begin", "case replicas"}, {"mutate", "replica mutations"},
                      {"deliver", "replica delta"}, {"read", "replica"}};
const Shapes MUTATIONS{{"add_vertex", "as type name link attributes?"}, {"add_edge", "from label to attributes?"},
                       {"update_attributes", "vertex|edge attributes"}, {"remove_edge", "from label to"},
                       {"move_edge", "old new attributes?"}, {"remove_vertex", "vertex"}};
const Shapes PARTS{{"link", "from|to label attributes?"}, {"edge", "from label to"}, {"old", "from label to"}, {"new", "from label to"}};

void shape(const Text& wanted, const json& given) {
    const auto require = [&](bool holds) { check(holds, "not {" + wanted + "}", "rejected_input"); };
    require(given.is_object());
    std::set<Text> known;
    std::istringstream parts(wanted);
    for (Text part; parts >> part;) {
        const bool is_optional = part.back() == '?';
        if (is_optional) part.pop_back();
        std::size_t count = 0;
        std::istringstream names(part);
        for (Text name; std::getline(names, name, '|'); known.insert(name)) count += given.count(name);
        require(count == 1 || (count == 0 && is_optional));
    }
    for (const auto& [name, value] : given.items()) {
        const bool is_list = name == "protocols" || name == "replicas" || name == "mutations";
        const bool is_part = PARTS.count(name) > 0;
        require(known.count(name) > 0);
        require(is_list ? value.is_array() : is_part || name == "attributes" ? value.is_object() : value.is_string());
        if (is_part) shape(PARTS.at(name), value);
    }
}

/// The name and the value of an object's one member.
std::pair<Text, json> only(const Shapes& shapes, const json& given, const Text& code) {
    check(given.is_object() && given.size() == 1, "not an object with one member", "rejected_input");
    const auto member = given.items().begin();
    check(shapes.count(member.key()) > 0, member.key() + " is not known", code);
    shape(shapes.at(member.key()), member.value());
    return {member.key(), member.value()};
}

/// Has all replicas of a case, its deltas, and the handles that are bound.
class Adapter {
public:
    json answer(const json& request) {
        check(request.size() == 2 && request.contains("do"), "not {id, do}", "rejected_input");
        const auto [command, given] = only(COMMANDS, request["do"], "unsupported");
        if (command == "hello") return hello(given);
        if (command == "case_begin") return case_begin(given);
        if (command == "mutate") return mutate(given);
        Graph& replica = known(replicas_, given["replica"]);
        if (command == "read") return {{"view", replica.view()}};
        replica.join(known(deltas_, given["delta"]));
        return json::object();
    }

private:
    std::map<Text, Graph> replicas_;
    std::map<Text, Graph::Delta> deltas_;
    std::set<Text> handles_;

    template <typename T>
    static T& known(std::map<Text, T>& named, const Text& name) {
        const auto found = named.find(name);
        check(found != named.end(), "nobody has named " + name, "unknown");
        return found->second;
    }

    static json hello(const json& given) {
        const json& offered = given["protocols"];
        check(std::find(offered.begin(), offered.end(), 1) != offered.end(), "this adapter speaks protocol 1", "unsupported");
        const json about{{"name", "my graph"}, {"version", "0.1.0"}, {"language", "C++"}, {"source", "adapter.cpp"}};
        return {{"protocol", 1},
                {"implementation", about},
                {"profiles", json::array({"observe"})},
                {"features", json::array()},
                {"limits", {{"line_bytes", 1 << 20}, {"replicas", 64}}}};
    }

    json case_begin(const json& given) {
        replicas_.clear();
        deltas_.clear();
        handles_ = {"root"};
        for (const auto& name : given["replicas"]) {
            check(name.is_string(), "the name of a replica is a text", "rejected_input");
            replicas_.emplace(name, Graph(replicas_.size()));
        }
        return json::object();
    }

    json mutate(const json& given) {
        auto bound = handles_;
        Graph::Group group;
        for (const auto& mutation : given["mutations"]) {
            group.push_back(only(MUTATIONS, mutation, "rejected_input"));
            const json& made = group.back().second;
            check_handles(made, bound);
            for (const auto& [part, _] : PARTS) {
                if (made.contains(part)) check_handles(made[part], bound);
            }
            if (!made.contains("as")) continue;
            check(bound.insert(made["as"]).second, "the handle is bound already", "rejected_input");
        }
        const auto delta = known(replicas_, given["replica"]).mutate(group);
        handles_ = bound;
        const Text name = "d" + std::to_string(deltas_.size());
        deltas_[name] = delta;
        return {{"delta", name}};
    }

    static void check_handles(const json& given, const std::set<Text>& bound) {
        for (const Text end : {"from", "to", "vertex"}) {
            if (given.contains(end)) check(bound.count(given[end]) > 0, "no vertex has the handle " + given[end].dump(), "unknown");
        }
    }
};

std::size_t members(const json& value) {
    std::size_t count = value.is_object() ? value.size() : 0;
    if (value.is_structured()) {
        for (const auto& item : value) count += members(item);
    }
    return count;
}

/// Whether no object names a key twice: a key that stands twice is read once.
bool names_each_key_once(const Text& line, const json& read) {
    std::size_t keys = 0;
    const auto count = [&](int, json::parse_event_t event, json&) { return keys += event == json::parse_event_t::key, true; };
    const json again = json::parse(line, count);
    return again.is_object() && keys == members(read);
}

int main() {
    std::ios::sync_with_stdio(false);
    Adapter adapter;
    for (Text line; std::getline(std::cin, line);) {
        json reply;
        try {
            // What is no request and has no id ends the conversation.
            const json request = json::parse(line);
            reply["id"] = request.at("id").get<std::uint64_t>();
            try {
                check(names_each_key_once(line, request), "a key stands twice", "rejected_input");
                reply["ok"] = adapter.answer(request);
            } catch (const Declined& why) {
                reply["error"] = {{"code", why.code}, {"message", why.message}};
            }
        } catch (const json::exception& why) {
            std::cerr << "no request: " << why.what() << '\n';
            return 1;
        }
        std::cout << reply.dump() << std::endl;
    }
}
