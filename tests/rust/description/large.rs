//! Long linkages: built in a time that grows little faster than their links.

use assur::{Description, Mechanism};

/// `dyads` RRR dyads, each between the one before and the ground, all their links of length 1.
fn chain(dyads: usize) -> Description {
    let mut d = Description::new().joint("O", [0.0, 0.0]).joint("J0", [0.6, 0.8]);
    let mut ground = vec!["O".to_string()];
    let mut links = vec![("crank".to_string(), vec!["O".to_string(), "J0".to_string()])];
    for i in 1..=dyads {
        let x = i as f64;
        let (pin, foot) = (format!("J{i}"), format!("G{i}"));
        let lean = 0.05 * (7.0 * x).sin();
        d = d.joint(&pin, [0.6 + x, 0.8 + lean]).joint(&foot, [x + 0.3 * lean, lean - 0.2]);
        links.push((format!("rod{i}"), vec![format!("J{}", i - 1), pin.clone()]));
        links.push((format!("rocker{i}"), vec![foot.clone(), pin]));
        ground.push(foot);
    }
    d = d.link("ground", ground.iter().map(String::as_str));
    for (name, joints) in &links {
        d = d.link(name, joints.iter().map(String::as_str));
    }
    d.driver("crank")
}

/// Two dyads a rung, both between the two pins of the rung before: each depends on all below it, in
/// twice as many ways a rung.
fn ladder(rungs: usize) -> Description {
    let mut d = Description::new().joint("O", [0.0, 0.0]).joint("A0", [0.5, 0.5]);
    d = d.joint("B0", [0.9, 0.4]).link("ground", ["O"]).link("crank", ["O", "A0", "B0"]);
    for k in 1..=rungs {
        let x = 0.5 + 0.9 * k as f64;
        let lean = 0.1 * (3.0 * x).sin();
        for (side, at) in [("A", [x, 0.9 + lean]), ("B", [x + 0.35, lean])] {
            let pin = format!("{side}{k}");
            d = d.joint(&pin, at);
            for from in ["A", "B"] {
                let joints = [format!("{from}{}", k - 1), pin.clone()];
                d = d.link(&format!("{from}{pin}"), joints.iter().map(String::as_str));
            }
        }
    }
    d.driver("crank")
}

#[test]
fn dyads_may_depend_on_others_in_many_ways() {
    // The ways are 2^60 here.
    let m = Mechanism::new(&ladder(60)).expect("a mechanism");
    assert_eq!(m.structure().groups.len(), 120);
}

#[test]
fn a_chain_has_as_many_dyads_as_were_hung_on_it() {
    for dyads in [1, 10, 500] {
        let m = Mechanism::new(&chain(dyads)).expect("a mechanism");
        assert_eq!(m.structure().mobility, 1);
        assert_eq!(m.structure().groups.len(), dyads);
        assert!(m.structure().groups.iter().all(|g| g.kind == Some("RRR")));
        // Each hangs on the one before.
        let first = m.structure().groups.iter().map(|g| g.links[0]).collect::<Vec<_>>();
        assert!(first.is_sorted(), "{first:?}");
    }
}
