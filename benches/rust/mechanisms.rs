//! Mechanisms of the benches.

use assur::{ClassIv, Description, FourBar, FourBarMode, Mechanism, SliderCrank};

pub fn four_bar() -> Mechanism {
    Mechanism::new(&FourBar::description(FourBarMode::Open)).expect("a mechanism")
}

pub fn jansen() -> Mechanism {
    let places = [
        (0.0, 0.0),
        (9.61, 11.52),
        (-38.0, -7.8),
        (-35.24, 33.61),
        (-77.75, -2.54),
        (-20.1, -42.79),
        (-56.05, -35.42),
        (-22.22, -91.74),
    ];
    let mut leg = Description::new();
    for (joint, (x, y)) in places.into_iter().enumerate() {
        leg = leg.joint(&joint.to_string(), [x, y]);
    }
    let leg = leg
        .link("ground", ["0", "2"])
        .link("crank", ["0", "1"])
        .link("upper", ["1", "3"])
        .link("shoulder", ["2", "3", "4"])
        .link("lower", ["1", "5"])
        .link("arm", ["2", "5"])
        .link("rod", ["4", "6"])
        .link("foot", ["5", "6", "7"]);
    Mechanism::new(&leg.driver("crank")).expect("a mechanism")
}

/// P4's mechanism of class IV.
pub fn class_iv() -> Mechanism {
    let joints = [
        [0.0, 0.0],
        [0.35, 0.0],
        [1.24, 0.99],
        [0.75, 1.91],
        [3.02, -0.73],
        [2.45, 1.02],
        [3.2, 2.24],
        [1.85, 2.35],
        [1.62, -1.11],
        [4.28, 1.52],
    ];
    Mechanism::new(&ClassIv::description(joints)).expect("a mechanism")
}

pub fn engine() -> Mechanism {
    Mechanism::new(&SliderCrank::description()).expect("a mechanism")
}

/// Two cranks, both driven, and two links between their pins.
pub fn five_bar() -> Mechanism {
    let five_bar = Description::new()
        .joint("A", [0.0, 0.0])
        .joint("B", [0.3, 0.9])
        .joint("C", [1.6, 2.2])
        .joint("D", [2.9, 0.8])
        .joint("E", [3.0, 0.0])
        .link("ground", ["A", "E"])
        .link("left_crank", ["A", "B"])
        .link("left_rod", ["B", "C"])
        .link("right_rod", ["D", "C"])
        .link("right_crank", ["E", "D"])
        .driver("left_crank")
        .driver("right_crank");
    Mechanism::new(&five_bar).expect("a mechanism")
}

/// A crank and as many dyads of two legs, each on the one before and the ground.
pub fn chain(dyads: u32) -> Mechanism {
    let mut chain = Description::new().joint("A", [0.0, 0.0]).joint("B0", [0.0, 1.0]);
    let mut ground = vec!["A".to_string()];
    for i in 1..=dyads {
        let x = 3.0 * f64::from(i);
        ground.push(format!("G{i}"));
        chain = chain
            .joint(&format!("B{i}"), [x, 3.0])
            .joint(&format!("G{i}"), [x, 0.0])
            .link(&format!("rod{i}"), [&*format!("B{}", i - 1), &*format!("B{i}")])
            .link(&format!("rocker{i}"), [&*format!("G{i}"), &*format!("B{i}")]);
    }
    let chain = chain
        .link("ground", ground.iter().map(String::as_str))
        .link("crank", ["A", "B0"])
        .driver("crank");
    Mechanism::new(&chain).expect("a mechanism")
}

pub fn all() -> [(&'static str, Mechanism); 3] {
    [("four_bar", four_bar()), ("engine", engine()), ("jansen", jansen())]
}
