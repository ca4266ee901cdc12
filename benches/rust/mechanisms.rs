//! Mechanisms of the benches.

use std::f64::consts::FRAC_PI_2;

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
#[cfg(feature = "test-hooks")]
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

/// The crank-rocker that others are built upon: joints A to D, a coupler point P.
fn four_bar_with_point() -> Description {
    Description::new()
        .joint("A", [0.0, 0.0])
        .joint("B", [0.0, 0.04])
        .joint("C", [0.093, 0.116])
        .joint("D", [0.1, 0.0])
        .joint("P", [0.03, 0.12])
        .link("crank", ["A", "B"])
        .link("coupler", ["B", "C", "P"])
        .link("rocker", ["D", "C"])
        .driver("crank")
}

/// Stephenson III: a second dyad on the coupler point.
fn stephenson() -> Description {
    four_bar_with_point()
        .joint("E", [0.18, 0.05])
        .joint("S", [0.1, 0.19])
        .link("ground", ["A", "D", "E"])
        .link("link", ["P", "S"])
        .link("lever", ["E", "S"])
}

/// A rod from the coupler point to a block on a bed.
fn press() -> Description {
    four_bar_with_point()
        .joint("F", [0.2, 0.1])
        .link("ground", ["A", "D"])
        .link("rod", ["P", "F"])
        .link("ram", ["F"])
        .slide("bed", "ram", "ground", 0.0, Some("A"))
}

/// A rod from the coupler point to a block on the rocker.
fn block_on_rocker() -> Description {
    four_bar_with_point()
        .joint("F", [0.085, 0.05])
        .link("ground", ["A", "D"])
        .link("rod", ["P", "F"])
        .link("block", ["F"])
        .slide("way", "block", "rocker", FRAC_PI_2, Some("D"))
}

/// Whitworth's quick return: a slotted lever, and a ram on its end.
fn whitworth() -> Description {
    Description::new()
        .joint("O", [0.0, 0.0])
        .joint("A", [0.0, 0.1])
        .joint("D", [0.0, -0.05])
        .joint("E", [0.0, -0.2])
        .joint("F", [0.36, -0.05])
        .link("ground", ["O", "D"])
        .link("crank", ["O", "A"])
        .link("block", ["A"])
        .link("lever", ["D", "E"])
        .link("rod", ["E", "F"])
        .link("ram", ["F"])
        .slide("slot", "block", "lever", FRAC_PI_2, Some("D"))
        .slide("bed", "ram", "ground", 0.0, Some("D"))
        .driver("crank")
}

/// Elliptic trammel, driven by its bar.
fn trammel() -> Description {
    Description::new()
        .joint("O", [0.0, 0.0])
        .joint("A", [0.096, 0.0])
        .joint("B", [0.0, 0.072])
        .joint("P", [0.16, -0.048])
        .link("ground", ["O"])
        .link("x_block", ["A"])
        .link("y_block", ["B"])
        .link("bar", ["B", "A", "P"])
        .slide("x", "x_block", "ground", 0.0, Some("O"))
        .slide("y", "y_block", "ground", FRAC_PI_2, Some("O"))
        .driver("bar")
}

/// Scotch yoke: a dyad with a guide that moves, and one that stands still.
fn scotch_yoke() -> Description {
    Description::new()
        .joint("O", [0.0, 0.0])
        .joint("A", [0.03, 0.04])
        .link("ground", ["O"])
        .link("crank", ["O", "A"])
        .link("block", ["A"])
        .link("yoke", [])
        .slide("slot", "yoke", "block", FRAC_PI_2, Some("A"))
        .slide("bed", "yoke", "ground", 0.0, Some("O"))
        .driver("crank")
}

/// Tangent generator: a pin on a rail and in the slot of the driven lever.
fn tangent_generator() -> Description {
    Description::new()
        .joint("O", [0.0, 0.0])
        .joint("A", [0.1, 0.0])
        .joint("H", [0.1, 0.0])
        .link("ground", ["O", "H"])
        .link("lever", ["O"])
        .link("block", ["A"])
        .link("cursor", ["A"])
        .slide("slot", "block", "lever", 0.0, Some("O"))
        .slide("rail", "cursor", "ground", FRAC_PI_2, Some("H"))
        .driver("lever")
}

/// A locomotive's wheels: the third rod is redundant.
fn parallel_cranks() -> Description {
    Description::new()
        .joint("A", [0.0, 0.0])
        .joint("D", [2.0, 0.0])
        .joint("G", [1.0, 0.0])
        .joint("B", [0.0, 0.5])
        .joint("C", [2.0, 0.5])
        .joint("F", [1.0, 0.5])
        .link("ground", ["A", "D", "G"])
        .link("crank", ["A", "B"])
        .link("rod", ["B", "C", "F"])
        .link("wheel", ["D", "C"])
        .link("third", ["G", "F"])
        .driver("crank")
}

/// Mechanisms that have all kernels together.
pub fn of_all_kernels() -> Vec<Mechanism> {
    let mut all: Vec<Mechanism> = [
        stephenson(),
        SliderCrank::description(),
        press(),
        block_on_rocker(),
        whitworth(),
        trammel(),
        scotch_yoke(),
        tangent_generator(),
        parallel_cranks(),
    ]
    .iter()
    .map(|description| Mechanism::new(description).expect("a mechanism"))
    .collect();
    all.push(driven(with_traced_triad(crank()), &["O", "E", "F"]));
    all
}

pub fn quick_return() -> Mechanism {
    Mechanism::new(&whitworth()).expect("a mechanism")
}

pub fn yoke() -> Mechanism {
    Mechanism::new(&scotch_yoke()).expect("a mechanism")
}

fn crank() -> Description {
    Description::new().joint("O", [0.0, 0.0]).joint("A", [0.3, 0.2]).link("crank", ["O", "A"])
}

/// A plate on three legs, one of them on the crank (class III).
fn with_triad(on: Description) -> Description {
    with_legs(on).link("plate", ["B", "C", "D"])
}

/// The same with a point of the plate, which is placed by its rotation.
fn with_traced_triad(on: Description) -> Description {
    with_legs(on).joint("P", [1.5, 2.5]).link("plate", ["B", "C", "D", "P"])
}

fn with_legs(on: Description) -> Description {
    on.joint("B", [1.0, 2.0])
        .joint("C", [2.5, 1.5])
        .joint("D", [2.0, 3.0])
        .joint("E", [4.0, 0.0])
        .joint("F", [0.0, 4.0])
        .link("rod", ["A", "B"])
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
