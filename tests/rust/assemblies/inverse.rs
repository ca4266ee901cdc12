//! Positions at which a coordinate has a value: a slider-crank, by the law of cosines.

use assur::{Description, Inverse, Mechanism, SolveError, Start, Status};

fn slider_crank(driver: &str) -> Description {
    Description::new()
        .joint("O", [0.0, 0.0])
        .joint("A", [0.6, 0.8])
        .joint("B", [3.4, 0.0])
        .link("ground", ["O"])
        .link("crank", ["O", "A"])
        .link("rod", ["A", "B"])
        .link("piston", ["B"])
        .slide("bore", "piston", "ground", 0.0, Some("O"))
        .driver(driver)
}

fn inverse(engine: &Mechanism) -> Inverse {
    let driven = Mechanism::new_for_pose(&slider_crank("bore")).unwrap();
    Inverse::new(engine, driven, &["bore".into()], &[None]).unwrap()
}

fn angle(x: f64, rod: f64) -> f64 {
    ((1.0 + x * x - rod * rod) / (2.0 * x)).acos()
}

#[test]
fn finds_both_positions_and_none_beyond_the_reach() {
    let engine = Mechanism::new(&slider_crank("crank")).unwrap();
    let inverse = inverse(&engine);
    assert!(inverse.is_quick() && inverse.drivers() == 1);
    let rod = 2.8_f64.hypot(0.8);
    for x in [2.1, 3.0, 3.6] {
        let answers = inverse.find(&engine, engine.drawing(), &[x], None).unwrap();
        assert!(answers.is_complete && answers.failures.is_empty());
        let [low, high] = &answers.found[..] else { panic!("{}", answers.found.len()) };
        assert!((low.q[0] + angle(x, rod)).abs() < 1e-14);
        assert!((high.q[0] - angle(x, rod)).abs() < 1e-14);
        assert_eq!([&low.assembly.signs, &high.assembly.signs], [engine.signs(); 2]);
    }
    let none = inverse.find(&engine, engine.drawing(), &[5.0], None).unwrap();
    assert!(none.found.is_empty() && none.is_complete);
    let refused = inverse.find(&engine, engine.drawing(), &[1.0, 2.0], None);
    assert!(matches!(refused, Err(SolveError::Shape(_))));
    let refused = inverse.find(&engine, &[1.0], &[1.0], None);
    assert!(refused.is_err());
}

#[test]
fn follows_values_and_waits_beyond_the_reach() {
    let engine = Mechanism::new(&slider_crank("crank")).unwrap();
    let inverse = inverse(&engine);
    let rod = 2.8_f64.hypot(0.8);
    let (dimensions, signs) = (engine.drawing(), engine.signs());
    let start = Start { mechanism: &engine, dimensions, signs, q: &[1.0] };
    let values = [3.0, 3.5, 4.5, 3.2, f64::NAN];
    let followed = inverse.follow(start, &values, None).unwrap();
    let status: Vec<Status> = followed.iter().map(|position| position.status).collect();
    let ok = Status::Ok;
    assert_eq!(status, [ok, ok, Status::Unreachable, ok, Status::BadInput]);
    for (position, x) in followed.iter().zip(values) {
        if position.status == ok {
            assert!((position.q[0] - angle(x, rod)).abs() < 1e-14);
        } else {
            assert!(position.q[0].is_nan());
        }
    }
    let refused = inverse.follow(Start { q: &[1.0, 2.0], ..start }, &values, None);
    assert!(matches!(refused, Err(SolveError::Shape(_))));
}

#[test]
fn refuses_what_does_not_belong_together() {
    let engine = Mechanism::new(&slider_crank("crank")).unwrap();
    let driven = || Mechanism::new_for_pose(&slider_crank("bore")).unwrap();
    let none = Inverse::new(&engine, driven(), &[], &[]);
    assert!(matches!(none, Err(SolveError::Shape(_))));
    let unknown = Inverse::new(&engine, driven(), &["bohr".into()], &[None]);
    assert!(matches!(unknown, Err(SolveError::Unknown { .. })));
    let base = Inverse::new(&engine, driven(), &["bore".into()], &[Some("ground.X.x".into())]);
    assert!(base.is_err());
}
