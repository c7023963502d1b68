//! Certified edges against a rigorous judge; `make campaign` does the same for a million.

#[path = "judge/distance.rs"]
mod distance;
mod edges_judge;

#[test]
fn no_edge_that_touches_is_called_free() {
    let tally = edges_judge::compare(1, 5_000);
    assert_eq!((tally.unsafe_called_free, tally.false_alarms_far), (0, 0), "{tally:?}");
    assert!(tally.free > 1_500 && tally.in_contact > 1_500, "{tally:?}");
    assert!(tally.undecided * 20 < tally.edges, "{tally:?}");
}
