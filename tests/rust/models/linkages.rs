//! Named linkages with numbers, as drawings.

use std::f64::consts::{FRAC_PI_2, PI};

use assur::{ClassIv, Description};

/// Links written as one-letter joints: `("coupler", "BCP")`.
fn bars(joints: &[(&str, [f64; 2])], links: &[(&str, &str)]) -> Description {
    let mut d = Description::new();
    for (name, at) in joints {
        d = d.joint(name, *at);
    }
    for (name, members) in links {
        let names: Vec<String> = members.chars().map(String::from).collect();
        d = d.link(name, names.iter().map(String::as_str));
    }
    d
}

/// The crank-rocker of P5 with a coupler point, without a driver.
fn four_bar() -> Description {
    bars(
        &[("A", [0.0, 0.0]), ("B", [1.0, 0.0]), ("C", [4.1, 3.2]), ("D", [4.8, 0.0])],
        &[("crank", "AB")],
    )
    .joint("P", [3.0, 4.0])
    .link("coupler", ["B", "C", "P"])
}

pub fn crank_rocker() -> Description {
    four_bar().link("ground", ["A", "D"]).link("rocker", ["D", "C"]).driver("crank")
}

/// Watt: a dyad between coupler and rocker.
pub fn watt() -> Description {
    four_bar()
        .joint("Q", [5.5, 3.0])
        .joint("S", [4.5, 5.5])
        .link("ground", ["A", "D"])
        .link("rocker", ["D", "C", "Q"])
        .link("l5", ["P", "S"])
        .link("l6", ["S", "Q"])
        .driver("crank")
}

/// Stephenson III: a dyad between coupler and ground.
pub fn stephenson(driver: &str) -> Description {
    four_bar()
        .joint("E", [7.0, 1.0])
        .joint("S", [6.0, 4.5])
        .link("ground", ["A", "D", "E"])
        .link("rocker", ["D", "C"])
        .link("l5", ["P", "S"])
        .link("l6", ["E", "S"])
        .driver(driver)
}

/// Theo Jansen's leg, foot `7`.
pub fn jansen() -> Description {
    bars(
        &[
            ("0", [0.0, 0.0]),
            ("1", [9.61, 11.52]),
            ("2", [-38.0, -7.8]),
            ("3", [-35.24, 33.61]),
            ("4", [-77.75, -2.54]),
            ("5", [-20.1, -42.79]),
            ("6", [-56.05, -35.42]),
            ("7", [-22.22, -91.74]),
        ],
        &[
            ("ground", "02"),
            ("crank", "01"),
            ("b", "13"),
            ("c", "234"),
            ("d", "15"),
            ("e", "25"),
            ("f", "46"),
            ("foot", "567"),
        ],
    )
    .driver("crank")
}

/// Class IV mechanism of P4 with the dimensions of `class_iv_reference.json`.
pub fn class_iv() -> Description {
    ClassIv::description([
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
    ])
}

/// A platform on three legs, one of them on a crank: a class III triad.
pub fn triad() -> Description {
    bars(
        &[
            ("A", [0.0, 0.0]),
            ("B", [0.4, 0.3]),
            ("P", [1.0, 2.0]),
            ("Q", [2.0, 2.2]),
            ("R", [1.6, 3.0]),
            ("D", [2.6, 0.4]),
            ("E", [0.2, 4.1]),
        ],
        &[
            ("ground", "ADE"),
            ("crank", "AB"),
            ("platform", "PQR"),
            ("first", "BP"),
            ("second", "DQ"),
            ("third", "ER"),
        ],
    )
    .driver("crank")
}

/// A five-bar; `drivers` of its cranks are driven.
pub fn five_bar(drivers: &[&str]) -> Description {
    let d = bars(
        &[
            ("A", [0.0, 0.0]),
            ("B", [0.3, 1.0]),
            ("C", [1.4, 2.0]),
            ("D", [2.5, 0.9]),
            ("E", [2.0, 0.0]),
        ],
        &[("ground", "AE"), ("left", "AB"), ("l2", "BC"), ("l3", "CD"), ("right", "ED")],
    );
    drivers.iter().fold(d, |d, name| d.driver(name))
}

/// A parallelogram with a third bar (exact in binary).
pub fn third_bar() -> Description {
    bars(
        &[
            ("A", [0.0, 0.0]),
            ("B", [0.75, 1.0]),
            ("C", [3.75, 1.0]),
            ("D", [3.0, 0.0]),
            ("E", [1.5, 0.0]),
            ("F", [2.25, 1.0]),
        ],
        &[("ground", "ADE"), ("crank", "AB"), ("rod", "BCF"), ("second", "DC"), ("third", "EF")],
    )
    .driver("crank")
}

/// Quick return: a block on a swinging arm, then a ram.
pub fn whitworth() -> Description {
    Description::new()
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
        .slide("slot", "block", "arm", 2.5_f64.atan2(1.0), Some("D"))
        .slide("bed", "ram", "ground", PI, Some("O"))
        .driver("crank")
}

pub fn scotch_yoke() -> Description {
    Description::new()
        .joint("O", [0.0, 0.0])
        .joint("A", [0.6, 0.8])
        .joint("Y", [2.0, 0.0])
        .link("ground", ["O"])
        .link("crank", ["O", "A"])
        .link("block", ["A"])
        .link("yoke", ["Y"])
        .slide("slot", "block", "yoke", FRAC_PI_2, Some("Y"))
        .slide("bed", "yoke", "ground", 0.0, Some("O"))
        .driver("crank")
}

/// A rod between two crossed slides.
pub fn trammel(driver: &str) -> Description {
    Description::new()
        .joint("O", [0.0, 0.0])
        .joint("A", [1.2, 0.0])
        .joint("B", [0.0, 0.5])
        .link("ground", ["O"])
        .link("sx", ["A"])
        .link("sy", ["B"])
        .link("rod", ["B", "A"])
        .slide("x", "sx", "ground", 0.0, Some("O"))
        .slide("y", "sy", "ground", FRAC_PI_2, Some("O"))
        .driver(driver)
}

/// Two shafts and a disc without joints between them.
pub fn oldham() -> Description {
    Description::new()
        .joint("O1", [0.0, 0.0])
        .joint("O2", [0.3, 0.1])
        .link("ground", ["O1", "O2"])
        .link("shaft1", ["O1"])
        .link("disc", [])
        .link("shaft2", ["O2"])
        .slide("tongue1", "disc", "shaft1", 0.4, Some("O1"))
        .slide("tongue2", "disc", "shaft2", 0.4 + FRAC_PI_2, Some("O2"))
        .driver("shaft1")
}
