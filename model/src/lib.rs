//! Exhaustive checking of concurrent replicas.
