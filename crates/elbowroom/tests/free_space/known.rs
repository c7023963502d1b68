//! Maps and refusals whose answers are known.

use super::*;

/// The 3-4-5 arm of the tangency tests: at the tip (0.3, 0.4) its second link stands upright at x = 0.3.
pub(crate) fn upright(half_width: f64, limits: JointLimits, obstacles: Vec<Obstacle>) -> Scene {
    let arm = build::arm_of(&[0.3, 0.4], half_width, &[Joint::CONTINUOUS, joint(limits)]);
    of_parts(arm, build::grid(0.8, 0.1), obstacles)
}

#[test]
fn touching_is_collision_and_the_limit_itself_is_allowed() {
    let tip = Point::new(0.3, 0.4);
    let right_angle = stops(-PI / 2.0, PI / 2.0);
    let state_at = |scene: &Scene, tip: Point| state_of(scene.two_link().unwrap(), tip, Posture::ElbowDown);
    let hit = CellState::Collision { link: 2, obstacle: 0 };
    for (half_width, radius, expected) in [
        (0.0, 0.1, hit),
        (0.0, 0.1 - 1e-8, CellState::Free),
        (0.02, 0.08, hit),
        (0.02, 0.08 - 1e-8, CellState::Free),
    ] {
        let scene = upright(half_width, right_angle, vec![circle(0.4, 0.2, radius)]);
        assert_eq!(state_at(&scene, tip), expected);
        let cell = scene.grid().nearest(tip).unwrap();
        assert_eq!(map_of(&scene).map(Posture::ElbowDown).state(cell), Some(expected));
    }
    let square =
        |left: f64| vec![build::polygon(&[[left, 0.1], [left + 0.1, 0.1], [left + 0.1, 0.2], [left, 0.2]])];
    assert_eq!(state_at(&upright(0.0, right_angle, square(0.3)), tip), hit);
    assert_eq!(state_at(&upright(0.0, right_angle, square(0.3 + 1e-8)), tip), CellState::Free);
}

#[test]
fn the_papers_three_cases_add_up() {
    let scene = upright(0.0, JointLimits::Continuous, Vec::new());
    let space = map_of(&scene);
    let cases = space.cases(scene.two_link().unwrap());
    assert_eq!(cases.two + cases.one + cases.none, scene.grid().len());
    // On this grid the reach of 0.7 m is met at the four ends of the axes, the hole of 0.1 m at its four.
    assert_eq!(cases.one, 8);
    let annulus = (0..scene.grid().len())
        .filter(|&cell| {
            let (column, row) = scene.grid().column_row(cell);
            let squared = (column as i64 - 8).pow(2) + (row as i64 - 8).pow(2);
            squared > 1 && squared < 49
        })
        .count();
    assert_eq!(cases.two, annulus);
    let reasons = space.map(Posture::ElbowUp).reasons();
    assert_eq!(reasons.free + reasons.out_of_reach, scene.grid().len());
}

#[test]
fn a_place_that_is_not_free_says_why_and_where_the_arm_could_stand() {
    let named = Obstacle { name: Some("post".to_owned()), ..circle(0.3, 0.3, 0.05) };
    let scene = upright(0.01, stops(0.0, PI), vec![circle(5.0, 5.0, 1.0), named]);
    let two = scene.two_link().unwrap();
    let refused = configurations(two, &Place::Tip(Point::new(0.3, 0.4))).unwrap_err();
    let [(up, limit), (down, contact)] = &refused.reasons[..] else { panic!("{refused:?}") };
    assert_eq!((*up, *down), (Some(Posture::ElbowUp), Some(Posture::ElbowDown)));
    assert!(matches!(limit, Reason::JointLimit { joint: 2, .. }));
    let Reason::Collision { link: 2, obstacle: 1, name: Some(name), depth } = contact else {
        panic!("{contact:?}")
    };
    assert!(name == "post" && (depth - 0.06).abs() < 1e-12);
    let nearest = refused.nearest_free.unwrap();
    let free = |p: Point| configurations(two, &Place::Tip(p)).is_ok();
    assert!(free(nearest));
    for cell in 0..scene.grid().len() {
        let p = scene.grid().point(cell);
        assert!(!free(p) || p.distance(Point::new(0.3, 0.4)) >= nearest.distance(Point::new(0.3, 0.4)));
    }
    let text = refused.to_string();
    assert!(
        text.contains("link 2 would penetrate obstacle 2 (post) by 0.0600 m")
            && text.contains("nearest free grid point"),
        "{text}"
    );

    let far = configurations(two, &Place::Tip(Point::new(2.0, 0.0))).unwrap_err();
    assert!(matches!(far.reasons[0].1, Reason::OutOfReach { distance: 2.0, .. }));
    let bent = configurations(two, &Place::Configuration([0.0, -0.1].into())).unwrap_err();
    assert!(matches!(bent.reasons[..], [(None, Reason::JointLimit { joint: 2, .. })]));
    let not_a_number = configurations(two, &Place::Configuration([f64::NAN, 0.1].into()));
    assert!(matches!(not_a_number.unwrap_err().reasons[..], [(None, Reason::JointLimit { joint: 1, .. })]));
}

#[test]
fn depth_in_a_polygon_is_that_of_the_innermost_point() {
    let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [0.0, 2.0]];
    let polygon = Shape::polygon(corners.map(|[x, y]| Point::new(x, y)).to_vec()).unwrap();
    let depth = |a: [f64; 2], b: [f64; 2]| {
        let segment = elbowroom::geometry::Segment::new(Point::new(a[0], a[1]), Point::new(b[0], b[1]));
        -polygon.signed_distance_to_segment(segment)
    };
    assert!((depth([-1.0, 1.0], [5.0, 1.0]) - 1.0).abs() < 1e-5);
    assert!((depth([-1.0, 0.5], [5.0, 0.5]) - 0.5).abs() < 1e-5);
    assert!((depth([-1.0, 1.0], [0.25, 1.0]) - 0.25).abs() < 1e-5);
    assert!((depth([-1.0, 0.0], [5.0, 0.0])).abs() < 1e-5);
    assert!((depth([0.0, 3.0], [4.0, 3.0]) + 1.0).abs() < 1e-12);
}

#[test]
fn a_map_that_is_stopped_is_no_map() {
    let scene = upright(0.0, JointLimits::Continuous, Vec::new());
    assert!(FreeSpace::of_until(scene.two_link().unwrap(), &|| false).is_none());
    assert!(FreeSpace::of_until(scene.two_link().unwrap(), &|| true).is_some());

    let fine = scene.with_grid(build::grid(0.8, 0.002));
    let asked = AtomicUsize::new(0);
    assert!(
        FreeSpace::of_until(fine.two_link().unwrap(), &|| asked.fetch_add(1, Ordering::Relaxed) < 100)
            .is_none()
    );
    assert!(asked.load(Ordering::Relaxed) < 200, "it was asked on after the first no");
}
