// 15. a joiner drops a write together with an older one
// A test of a crate that depends on `dsr-model`. A semantics that `dsr-model` does not know is replayed by
// `dsr_model::replay::replay_with(&semantics, &trace)`.
//
//   1. agent 1: sets #1.x = 2  → m1
//   2. agent 2: receives m1
//   3. agent 3: receives m1
//   4. agent 2: sends agent 3 what it lacks  → m2
//   5. agent 1: sets #1.x = 3  → m3
//   6. agent 2: receives m3
//   7. agent 3: receives m3
//   8. agent 3: receives m2
//      ✗ [JOIN-5] nothing is under way, and replicas differ: only agent 1 shows #1.x = 3; only agent 3 shows #1.x = 2

use dsr_model::replay::replay;
use dsr_model::trace::Trace;

#[test]
fn replays_join_5_15_a_joiner_drops_a_write_together_with_an_older() {
    let trace = Trace::read(TRACE).expect("a trace");
    if let Err(difference) = replay(&trace) {
        panic!("{difference}");
    }
}

const TRACE: &str = r##"{
  "format": "dsr-trace",
  "version": 2,
  "title": "15. a joiner drops a write together with an older one",
  "semantics": "published",
  "setup": {
    "row": "15"
  },
  "layer": "gallery",
  "bound": "3 replicas, 2 calls, order by pair, 1 joiner",
  "replicas": [
    {
      "name": "agent 1",
      "index": 0,
      "starts": {
        "elements": {
          "#1": {
            "is": "vertex",
            "name": "#1 k",
            "type": "thing",
            "attributes": {
              "x": "1"
            }
          }
        }
      }
    },
    {
      "name": "agent 2",
      "index": 1,
      "starts": {
        "elements": {
          "#1": {
            "is": "vertex",
            "name": "#1 k",
            "type": "thing",
            "attributes": {
              "x": "1"
            }
          }
        }
      }
    },
    {
      "name": "agent 3",
      "index": 2,
      "starts": {
        "elements": {}
      }
    }
  ],
  "steps": [
    {
      "replica": "agent 1",
      "does": {
        "mutate": {
          "text": "sets #1.x = 2",
          "mutations": [
            {
              "set": {
                "key": "x",
                "node": 1,
                "value": 2
              }
            }
          ],
          "sends": [
            {
              "message": "m1",
              "text": "#1.x = 2",
              "delta": {
                "parts": [
                  {
                    "delta": {
                      "seen": [
                        "1 to 0.2"
                      ],
                      "values": {
                        "0.2": {
                          "agent": 1,
                          "value": "2"
                        }
                      }
                    },
                    "sender": 1,
                    "what": "#1.x"
                  }
                ],
                "time": 1000,
                "topic": "node attributes"
              }
            }
          ]
        }
      },
      "changes": [
        {
          "element": "#1",
          "before": {
            "is": "vertex",
            "name": "#1 k",
            "type": "thing",
            "attributes": {
              "x": "1"
            }
          },
          "after": {
            "is": "vertex",
            "name": "#1 k",
            "type": "thing",
            "attributes": {
              "x": "2"
            }
          }
        }
      ],
      "state": "2256ffa8900876ea"
    },
    {
      "replica": "agent 2",
      "does": {
        "deliver": {
          "message": "m1"
        }
      },
      "changes": [
        {
          "element": "#1",
          "before": {
            "is": "vertex",
            "name": "#1 k",
            "type": "thing",
            "attributes": {
              "x": "1"
            }
          },
          "after": {
            "is": "vertex",
            "name": "#1 k",
            "type": "thing",
            "attributes": {
              "x": "2"
            }
          }
        }
      ],
      "state": "9d1971c33bf295bf"
    },
    {
      "replica": "agent 3",
      "does": {
        "deliver": {
          "message": "m1"
        }
      },
      "changes": [
        {
          "remark": "#1.x waits for its node",
          "holds": true
        }
      ],
      "state": "0f3738277b119c1d"
    },
    {
      "replica": "agent 2",
      "does": {
        "answer": {
          "to": "agent 3",
          "sends": [
            {
              "message": "m2",
              "text": "the whole graph: #1",
              "delta": {
                "nodes": {
                  "#1": {
                    "seen": [
                      "1 to 0.1"
                    ],
                    "values": {
                      "0.1": {
                        "agent": 1,
                        "attributes": {
                          "x": {
                            "seen": [
                              "1 to 0.2"
                            ],
                            "values": {
                              "0.2": {
                                "agent": 1,
                                "value": "2"
                              }
                            }
                          }
                        },
                        "edges": {},
                        "name": "k",
                        "type": "thing"
                      }
                    }
                  }
                },
                "time": 2000,
                "topic": "graph"
              }
            }
          ]
        }
      },
      "state": "9d1971c33bf295bf"
    },
    {
      "replica": "agent 1",
      "does": {
        "mutate": {
          "text": "sets #1.x = 3",
          "mutations": [
            {
              "set": {
                "key": "x",
                "node": 1,
                "value": 3
              }
            }
          ],
          "sends": [
            {
              "message": "m3",
              "text": "#1.x = 3",
              "delta": {
                "parts": [
                  {
                    "delta": {
                      "seen": [
                        "0.2",
                        "0.3"
                      ],
                      "values": {
                        "0.3": {
                          "agent": 1,
                          "value": "3"
                        }
                      }
                    },
                    "sender": 1,
                    "what": "#1.x"
                  }
                ],
                "time": 3000,
                "topic": "node attributes"
              }
            }
          ]
        }
      },
      "changes": [
        {
          "element": "#1",
          "before": {
            "is": "vertex",
            "name": "#1 k",
            "type": "thing",
            "attributes": {
              "x": "2"
            }
          },
          "after": {
            "is": "vertex",
            "name": "#1 k",
            "type": "thing",
            "attributes": {
              "x": "3"
            }
          }
        }
      ],
      "state": "00088282098bc0b3"
    },
    {
      "replica": "agent 2",
      "does": {
        "deliver": {
          "message": "m3"
        }
      },
      "changes": [
        {
          "element": "#1",
          "before": {
            "is": "vertex",
            "name": "#1 k",
            "type": "thing",
            "attributes": {
              "x": "2"
            }
          },
          "after": {
            "is": "vertex",
            "name": "#1 k",
            "type": "thing",
            "attributes": {
              "x": "3"
            }
          }
        }
      ],
      "state": "418b5646b5748106"
    },
    {
      "replica": "agent 3",
      "does": {
        "deliver": {
          "message": "m3"
        }
      },
      "state": "af0cd98146a9961a"
    },
    {
      "replica": "agent 3",
      "does": {
        "deliver": {
          "message": "m2"
        }
      },
      "changes": [
        {
          "element": "#1",
          "before": null,
          "after": {
            "is": "vertex",
            "name": "#1 k",
            "type": "thing",
            "attributes": {
              "x": "2"
            }
          }
        },
        {
          "remark": "#1.x waits for its node",
          "holds": false
        }
      ],
      "state": "80603d88ab986588"
    }
  ],
  "finding": {
    "kind": "broken",
    "clause": "JOIN-5",
    "what": "nothing is under way, and replicas differ",
    "detail": "nothing is under way, and replicas differ: only agent 1 shows #1.x = 3; only agent 3 shows #1.x = 2",
    "replicas": [
      "agent 1",
      "agent 2",
      "agent 3"
    ]
  }
}"##;
