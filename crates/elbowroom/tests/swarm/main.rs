//! The plain swarm: equal to a naive one bit for bit, inside its box, and as good as it says.

#![expect(clippy::unwrap_used, reason = "a test's own set-up may panic")]

mod naive;

use naive::NaiveSwarm;
use std::f64::consts::{E, TAU};

use elbowroom::swarm::{
    Bounds, BoundsError, MAX_COORDINATES, Neighbourhood, Swarm, SwarmError, SwarmSettings, minimise,
};
use proptest::prelude::*;
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

fn sphere(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum()
}

fn rosenbrock(x: &[f64]) -> f64 {
    x.windows(2).map(|x| 100.0 * (x[1] - x[0] * x[0]).powi(2) + (1.0 - x[0]).powi(2)).sum()
}

fn rastrigin(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x - 10.0 * (TAU * x).cos() + 10.0).sum()
}

fn ackley(x: &[f64]) -> f64 {
    let n = x.len() as f64;
    let waves: f64 = x.iter().map(|x| (TAU * x).cos()).sum();
    20.0 + E - 20.0 * (-0.2 * (sphere(x) / n).sqrt()).exp() - (waves / n).exp()
}

fn griewank(x: &[f64]) -> f64 {
    let waves: f64 = x.iter().enumerate().map(|(i, x)| (x / (i as f64 + 1.0).sqrt()).cos()).product();
    1.0 + sphere(x) / 4000.0 - waves
}

fn cube(dimensions: usize, half_width: f64) -> Bounds {
    Bounds::new(&vec![[-half_width, half_width]; dimensions]).unwrap()
}

/// Shares of 50 seeds: they leave room below what is seen, since another platform's cosine leads elsewhere.
#[test]
fn comes_to_the_minimum_of_standard_functions() {
    const GLOBAL: Neighbourhood = Neighbourhood::Global;
    const RING: Neighbourhood = Neighbourhood::Ring { k: 2 };
    // Objective, half width of the box, then dimensions, neighbourhood, value and least share that reaches it.
    type Goal = (usize, Neighbourhood, f64, f64);
    type Function = (fn(&[f64]) -> f64, f64, &'static [Goal]);
    let functions: [Function; 5] = [
        (sphere, 5.12, &[(2, RING, 1e-30, 1.0), (30, GLOBAL, 1e-5, 1.0), (30, RING, 2e-3, 1.0)]),
        (rosenbrock, 2.048, &[(2, GLOBAL, 1e-12, 1.0), (2, RING, 1e-9, 1.0), (10, RING, 9.0, 1.0)]),
        (rastrigin, 5.12, &[(2, GLOBAL, 0.0, 1.0), (2, RING, 0.0, 1.0), (10, GLOBAL, 5.0, 0.7)]),
        (ackley, 32.768, &[(2, GLOBAL, 1e-14, 1.0), (10, GLOBAL, 1e-10, 1.0), (10, RING, 1e-6, 1.0)]),
        (griewank, 600.0, &[(2, RING, 1e-9, 0.7), (2, GLOBAL, 0.0074, 0.95), (10, RING, 0.15, 0.9)]),
    ];
    for (function, (objective, half_width, goals)) in functions.into_iter().enumerate() {
        for &(dimensions, neighbourhood, value, share) in goals {
            let settings = SwarmSettings { neighbourhood, ..SwarmSettings::default() };
            let bounds = cube(dimensions, half_width);
            let reached = (0..50)
                .filter(|&seed| minimise(objective, &bounds, &settings, seed).unwrap().value <= value)
                .count();
            let case = format!("function {function}, {dimensions}-D, {neighbourhood:?}");
            assert!(reached as f64 >= share * 50.0, "{case}: {reached} of 50 reach {value}");
        }
    }
}

/// On an end it is that end, the upper one if they are equal: this settles the sign of a zero.
fn clamped(value: f64, min: f64, max: f64) -> f64 {
    if value >= max || min >= max {
        max
    } else if value <= min {
        min
    } else {
        value
    }
}

/// A number in [0, 1) from 32 random bits.
fn unit(rng: &mut ChaCha8Rng) -> f64 {
    f64::from(rng.next_u32()) / 4_294_967_296.0
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

/// Some of it not a number, infinite either way round, or flat, so that many values are equal.
fn wild(x: &[f64]) -> f64 {
    match (x[0] * 4.0).floor().rem_euclid(5.0) as u8 {
        0 => f64::NAN,
        1 => f64::INFINITY,
        2 => 3.0,
        _ => sphere(x).floor(),
    }
}

fn settings() -> impl Strategy<Value = SwarmSettings> {
    let neighbourhood = (1usize..24).prop_flat_map(|particles| {
        let ring = (0..particles).prop_map(|k| Neighbourhood::Ring { k });
        (Just(particles), prop_oneof![Just(Neighbourhood::Global), ring])
    });
    let coefficient = || prop_oneof![Just(0.0), 0.0..3.0];
    let v_max = proptest::option::of(prop_oneof![0.001..2.0, Just(1e-300), Just(1e300)]);
    (neighbourhood, coefficient(), coefficient(), coefficient(), coefficient(), v_max, 1usize..100).prop_map(
        |((particles, neighbourhood), first, last, c_personal, c_neighbour, v_max, iterations)| {
            let inertia = [first, last].map(|inertia| inertia / 2.0);
            SwarmSettings {
                particles,
                neighbourhood,
                first_inertia: inertia[0],
                last_inertia: inertia[1],
                c_personal,
                c_neighbour,
                v_max,
                iterations,
            }
        },
    )
}

fn ranges() -> impl Strategy<Value = Vec<[f64; 2]>> {
    let end = || prop_oneof![-10.0..10.0, Just(0.0), Just(-0.0), -1e-300..1e-300, -1e9..1e9];
    proptest::collection::vec((end(), end()).prop_map(|(a, b)| if a <= b { [a, b] } else { [b, a] }), 1..12)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn moves_like_the_naive_swarm_bit_for_bit(
        settings in settings(), ranges in ranges(), seed: u64, which in 0usize..4
    ) {
        let objective = [sphere, rastrigin, wild, |_: &[f64]| f64::NAN][which];
        let bounds = Bounds::new(&ranges).unwrap();
        let mut swarm = Swarm::new(&bounds, &settings, seed).unwrap();
        let mut naive = NaiveSwarm::new(&ranges, settings, seed);
        for iteration in 0..60 {
            for (i, (position, velocity)) in swarm.positions().zip(swarm.velocities()).enumerate() {
                prop_assert_eq!(bits(position), bits(&naive.particles[i].position), "particle {}", i);
                prop_assert_eq!(bits(velocity), bits(&naive.particles[i].velocity), "particle {}", i);
                prop_assert!(bounds.contains(position));
                for (v, [min, max]) in velocity.iter().zip(&ranges) {
                    let limit = settings.v_max.map_or(f64::INFINITY, |share| share * (max - min));
                    prop_assert!(v.abs() <= limit);
                }
            }
            swarm.step(&mut |x| objective(x));
            naive.step(objective);
            for (i, &neighbour) in swarm.neighbour_bests().iter().enumerate() {
                prop_assert_eq!(neighbour, naive.neighbour_best(i));
            }
            let (position, value) = swarm.best();
            prop_assert_eq!(bits(position), bits(&naive.best().personal_best));
            prop_assert_eq!(value.to_bits(), naive.best().value.to_bits());
            prop_assert_eq!(swarm.iterations(), iteration + 1);
            prop_assert_eq!(swarm.evaluations(), (iteration + 1) * settings.particles);
        }
    }
}

/// A swarm on a line whose personal bests are those that the objective says at the first step.
fn with_values(values: &[f64], neighbourhood: Neighbourhood) -> Swarm {
    let settings = SwarmSettings { particles: values.len(), neighbourhood, ..SwarmSettings::default() };
    let mut swarm = Swarm::new(&cube(1, 1.0), &settings, 0).unwrap();
    let mut given = values.iter();
    swarm.step(&mut |_| *given.next().unwrap());
    swarm
}

#[test]
fn the_ring_is_closed() {
    let values = [3.0, 9.0, 9.5, 8.0, 7.0, 7.5, 1.0, 4.0];
    let bests = |k| with_values(&values, Neighbourhood::Ring { k }).neighbour_bests().to_vec();
    assert_eq!(bests(0), [0, 1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(bests(1), [0, 0, 3, 4, 4, 6, 6, 6]);
    assert_eq!(bests(2), [6, 0, 0, 4, 6, 6, 6, 6]);
    assert_eq!(bests(3), [6, 6, 0, 6, 6, 6, 6, 6]);
    for k in 4..8 {
        assert_eq!(bests(k), [6; 8]);
    }
    assert_eq!(with_values(&values, Neighbourhood::Global).neighbour_bests(), [6; 8]);
}

#[test]
fn of_equal_personal_bests_the_first_particles_counts() {
    let bests =
        |k| with_values(&[2.0, 2.0, 5.0, 5.0, 5.0], Neighbourhood::Ring { k }).neighbour_bests().to_vec();
    assert_eq!(bests(1), [0, 0, 1, 2, 0]);
    assert_eq!(bests(2), [0; 5]);
}

#[test]
fn one_particle_moves_by_its_own_memory() {
    for neighbourhood in [Neighbourhood::Global, Neighbourhood::Ring { k: 0 }] {
        let settings = SwarmSettings { particles: 1, neighbourhood, ..SwarmSettings::default() };
        let found = minimise(sphere, &cube(2, 5.0), &settings, 3).unwrap();
        assert!(found.value < 1.0, "{found:?}");
        assert_eq!(found.evaluations, 1000);
    }
}

#[test]
fn a_minimum_on_the_boundary_is_reached_exactly() {
    let bounds = Bounds::new(&[[1.0, 4.0], [-3.0, -2.0], [0.5, 0.5]]).unwrap();
    let found = minimise(sphere, &bounds, &SwarmSettings::default(), 5).unwrap();
    assert_eq!(found.position, [1.0, -2.0, 0.5]);
    assert_eq!(found.value, 5.25);
}

#[test]
fn what_is_not_a_number_counts_as_infinite() {
    let half = |x: &[f64]| if x[0] < 0.3 { f64::NAN } else { sphere(x) };
    let found = minimise(half, &cube(3, 1.0), &SwarmSettings::default(), 1).unwrap();
    assert!(found.position[0] >= 0.3 && found.value < 0.0901, "{found:?}");

    for hopeless in [f64::NAN, f64::INFINITY] {
        let found = minimise(|_| hopeless, &cube(3, 1.0), &SwarmSettings::default(), 1).unwrap();
        assert!(found.value == f64::INFINITY && cube(3, 1.0).contains(&found.position));
    }
    let bottomless = |x: &[f64]| if x[0] > 0.9 { f64::NEG_INFINITY } else { x[1] };
    let found = minimise(bottomless, &cube(3, 1.0), &SwarmSettings::default(), 1).unwrap();
    assert!(found.value == f64::NEG_INFINITY && found.position[0] > 0.9);
}

#[test]
fn huge_boxes_and_pulls_stay_in_the_box() {
    let bounds = cube(3, 0.49 * f64::MAX);
    for v_max in [None, Some(1e-300), Some(1.0), Some(f64::MAX)] {
        let settings = SwarmSettings {
            v_max,
            first_inertia: f64::MAX,
            c_personal: f64::MAX,
            c_neighbour: f64::MAX,
            ..SwarmSettings::default()
        };
        let mut swarm = Swarm::new(&bounds, &settings, 0).unwrap();
        for _ in 0..200 {
            swarm.step(&mut |x| x[0] - x[1]);
            assert!(swarm.positions().all(|position| bounds.contains(position)));
            assert!(swarm.velocities().flatten().all(|velocity| velocity.is_finite()));
        }
    }
}

#[test]
fn the_seed_alone_decides() {
    let run = |seed| minimise(rastrigin, &cube(5, 5.12), &SwarmSettings::default(), seed).unwrap();
    assert_eq!(run(1), run(1));
    assert_ne!(run(1).position, run(2).position);
    // Stepping is the same as one shot, and a whole-swarm ring the same as the global neighbourhood.
    let settings = SwarmSettings { neighbourhood: Neighbourhood::Ring { k: 25 }, ..SwarmSettings::default() };
    let mut swarm = Swarm::new(&cube(5, 5.12), &settings, 1).unwrap();
    for _ in 0..settings.iterations {
        swarm.step(&mut rastrigin);
    }
    assert_eq!(swarm.best(), (run(1).position.as_slice(), run(1).value));
}

#[test]
fn bounds_are_checked() {
    assert_eq!(Bounds::new(&[]), Err(BoundsError::Dimensions { found: 0 }));
    let (inf, nan) = (f64::INFINITY, f64::NAN);
    for [min, max] in [[1.0, 0.0], [-inf, 0.0], [0.0, inf], [-inf, inf], [inf, inf], [nan, 1.0], [0.0, nan]] {
        match Bounds::new(&[[0.0, 1.0], [min, max]]) {
            Err(BoundsError::Range { dimension: 1, min: a, max: b }) => {
                assert_eq!(bits(&[a, b]), bits(&[min, max]));
            }
            other => panic!("{other:?}"),
        }
    }
    let wide = Bounds::new(&[[-f64::MAX, f64::MAX]]);
    assert_eq!(wide, Err(BoundsError::Range { dimension: 0, min: -f64::MAX, max: f64::MAX }));
    let bounds = Bounds::new(&[[-1.0, 2.0], [3.0, 3.0]]).unwrap();
    assert_eq!((bounds.dimensions(), bounds.min(), bounds.max()), (2, &[-1.0, 3.0][..], &[2.0, 3.0][..]));
    assert!(bounds.contains(&[2.0, 3.0]) && !bounds.contains(&[2.1, 3.0]) && !bounds.contains(&[0.0]));
    assert!(!bounds.contains(&[f64::NAN, 3.0]));
}

#[test]
fn settings_are_checked() {
    let good = SwarmSettings::default();
    assert_eq!(good.check(), Ok(()));
    let bounds = cube(30, 1.0);
    let wrong = |settings: SwarmSettings| {
        assert_eq!(settings.check().err(), Swarm::<f64>::new(&bounds, &settings, 0).err());
        settings.check().unwrap_err()
    };
    let ring = |particles, k| SwarmSettings { particles, neighbourhood: Neighbourhood::Ring { k }, ..good };
    assert_eq!(ring(5, 4).check(), Ok(()));
    assert_eq!(wrong(ring(5, 5)), SwarmError::Ring { k: 5, particles: 5 });
    assert_eq!(wrong(ring(1, 1)), SwarmError::Ring { k: 1, particles: 1 });
    assert_eq!(wrong(ring(7, usize::MAX)), SwarmError::Ring { k: usize::MAX, particles: 7 });
    assert_eq!(wrong(SwarmSettings { iterations: 0, ..good }), SwarmError::Iterations);
    for value in [-1.0, f64::NEG_INFINITY, f64::INFINITY] {
        let coefficient = |name| SwarmError::Coefficient { name, value };
        assert_eq!(wrong(SwarmSettings { first_inertia: value, ..good }), coefficient("first_inertia"));
        assert_eq!(wrong(SwarmSettings { last_inertia: value, ..good }), coefficient("last_inertia"));
        assert_eq!(wrong(SwarmSettings { c_personal: value, ..good }), coefficient("c_personal"));
        assert_eq!(wrong(SwarmSettings { c_neighbour: value, ..good }), coefficient("c_neighbour"));
        assert_eq!(wrong(SwarmSettings { v_max: Some(value), ..good }), SwarmError::Speed { value });
    }
    assert_eq!(wrong(SwarmSettings { v_max: Some(0.0), ..good }), SwarmError::Speed { value: 0.0 });
    let nan = SwarmSettings { c_personal: f64::NAN, ..good };
    assert!(matches!(nan.check(), Err(SwarmError::Coefficient { name: "c_personal", .. })));
    let nan = SwarmSettings { v_max: Some(f64::NAN), ..good };
    assert!(matches!(nan.check(), Err(SwarmError::Speed { .. })));

    for particles in [0, MAX_COORDINATES / 30 + 1, usize::MAX] {
        let crowd = SwarmSettings { particles, ..good };
        let error = Swarm::<f64>::new(&bounds, &crowd, 0).unwrap_err();
        assert_eq!(error, SwarmError::Particles { particles, dimensions: 30 });
    }
}
