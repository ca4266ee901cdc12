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

pub fn all() -> [(&'static str, Mechanism); 3] {
    [("four_bar", four_bar()), ("engine", engine()), ("jansen", jansen())]
}

fn crank() -> Description {
    Description::new().joint("O", [0.0, 0.0]).joint("A", [0.3, 0.2]).link("crank", ["O", "A"])
}

/// A plate on three legs, one of them on the crank (class III).
fn with_triad(on: Description) -> Description {
    on.joint("B", [1.0, 2.0])
        .joint("C", [2.5, 1.5])
        .joint("D", [2.0, 3.0])
        .joint("E", [4.0, 0.0])
        .joint("F", [0.0, 4.0])
        .link("rod", ["A", "B"])
        .link("plate", ["B", "C", "D"])
        .link("right", ["C", "E"])
        .link("left", ["D", "F"])
}

/// A dyad from a joint to the ground.
fn with_dyad(on: Description, from: &str, tip: [f64; 2], end: [f64; 2]) -> Description {
    on.joint("G", tip).joint("H", end).link("upper", [from, "G"]).link("lower", ["G", "H"])
}

fn driven(chain: Description, ground: &[&str]) -> Mechanism {
    let ground = ground.iter().copied();
    Mechanism::new(&chain.link("ground", ground).driver("crank")).expect("a mechanism")
}

pub fn triad() -> Mechanism {
    driven(with_triad(crank()), &["O", "E", "F"])
}

pub fn dyad() -> Mechanism {
    driven(with_dyad(crank(), "A", [-1.0, 1.2], [-1.5, 0.0]), &["O", "H"])
}

/// Both on one crank.
pub fn triad_beside_dyad() -> Mechanism {
    let both = with_dyad(with_triad(crank()), "A", [-1.0, 1.2], [-1.5, 0.0]);
    driven(both, &["O", "E", "F", "H"])
}

/// The dyad hangs on the triad's plate.
pub fn dyad_on_triad() -> Mechanism {
    let both = with_dyad(with_triad(crank()), "D", [3.0, 4.0], [5.0, 2.5]);
    driven(both, &["O", "E", "F", "H"])
}

/// A block on a swinging arm, then a ram.
pub fn whitworth() -> Mechanism {
    let description = Description::new()
        .joint("O", [0.0, 0.0])
        .joint("A", [1.0, 0.5])
        .joint("D", [0.0, -2.0])
        .joint("E", [2.0, 3.0])
        .joint("F", [-1.0, 3.5])
        .link("ground", ["O", "D"])
        .link("crank", ["O", "A"])
        .link("block", ["A"])
        .link("arm", ["D", "E"])
        .link("rod", ["E", "F"])
        .link("ram", ["F"])
        .slide("slot", "block", "arm", assur::trig::atan2(2.5, 1.0), Some("D"))
        .slide("bed", "ram", "ground", std::f64::consts::PI, Some("O"))
        .driver("crank");
    Mechanism::new(&description).expect("a mechanism")
}

pub fn scotch_yoke() -> Mechanism {
    let description = Description::new()
        .joint("O", [0.0, 0.0])
        .joint("A", [0.6, 0.8])
        .joint("Y", [2.0, 0.0])
        .link("ground", ["O"])
        .link("crank", ["O", "A"])
        .link("block", ["A"])
        .link("yoke", ["Y"])
        .slide("slot", "block", "yoke", std::f64::consts::FRAC_PI_2, Some("Y"))
        .slide("bed", "yoke", "ground", 0.0, Some("O"))
        .driver("crank");
    Mechanism::new(&description).expect("a mechanism")
}
