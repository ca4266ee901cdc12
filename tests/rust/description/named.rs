//! What named linkages are made of, and what is no mechanism.

use std::f64::consts::{FRAC_PI_2, PI};

use assur::{Description, Group, Mechanism, SliderCrank, StructureError};

use crate::models::linkages as l;

fn mechanism(description: &Description) -> Mechanism {
    Mechanism::new(description).unwrap_or_else(|error| panic!("{error}"))
}

/// Formula, and class, order and kind of every group.
fn assert_structure(
    description: &Description,
    formula: &str,
    groups: &[(usize, usize, Option<&str>)],
) {
    let mechanism = mechanism(description);
    let structure = mechanism.structure();
    assert_eq!(structure.formula(), formula);
    let found: Vec<_> = structure.groups.iter().map(|g| (g.class, g.order, g.kind)).collect();
    assert_eq!(found, groups, "{formula}");
    assert_eq!(structure.class(), groups.iter().map(|g| g.0).max().unwrap_or(1));
    assert_eq!(structure.mobility, description.drivers.len());
    assert_eq!(usize::try_from(structure.mobility_counted), Ok(structure.mobility));
    assert!(structure.redundant.links.is_empty() && structure.redundant.slides.is_empty());
}

const RRR: (usize, usize, Option<&str>) = (2, 2, Some("RRR"));
const RRP: (usize, usize, Option<&str>) = (2, 2, Some("RRP"));
const RPR: (usize, usize, Option<&str>) = (2, 2, Some("RPR"));
const RPP: (usize, usize, Option<&str>) = (2, 2, Some("RPP"));

#[test]
fn four_bars() {
    assert_structure(&l::crank_rocker(), "I(crank) → II(coupler, rocker)", &[RRR]);
    assert_structure(&SliderCrank::description(), "I(crank) → II(rod, piston)", &[RRP]);
    assert_structure(&l::five_bar(&["left", "right"]), "I(left, right) → II(l2, l3)", &[RRR]);
}

#[test]
fn slides() {
    let formula = "I(crank) → II(block, arm) → II(rod, ram)";
    assert_structure(&l::whitworth(), formula, &[RPR, RRP]);
    assert_structure(&l::scotch_yoke(), "I(crank) → II(block, yoke)", &[RPP]);
    assert_structure(&l::oldham(), "I(shaft1) → II(disc, shaft2)", &[RPP]);
    assert_structure(&l::trammel("x"), "I(x) → II(sy, rod)", &[RRP]);
}

#[test]
fn artobolevskys_numbers() {
    for (description, numbers) in
        [(l::crank_rocker(), vec![1]), (l::whitworth(), vec![3, 2]), (l::scotch_yoke(), vec![5])]
    {
        let mechanism = mechanism(&description);
        let groups = mechanism.structure().groups.iter();
        assert_eq!(groups.filter_map(Group::artobolevsky_kind).collect::<Vec<_>>(), numbers);
    }
}

/// With its rod's angle driven a trammel is two slides joined by a rod that only
/// shifts: a PRP dyad whose inner joint is the rod.
#[test]
fn trammel_by_its_rod() {
    let trammel = mechanism(&l::trammel("rod"));
    assert_eq!(trammel.structure().formula(), "I(rod) → II(sx, sy)");
    assert_eq!(trammel.structure().groups.len(), 1);
    assert_eq!(trammel.structure().groups[0].kind, Some("PRP"));
}

#[test]
fn six_bars_and_more() {
    let rest = "→ II(coupler, rocker) → II(l5, l6)";
    assert_structure(&l::watt(), &format!("I(crank) {rest}"), &[RRR, RRR]);
    assert_structure(&l::stephenson("crank"), &format!("I(crank) {rest}"), &[RRR, RRR]);
    let formula = "I(crank) → II(b, c) → II(d, e) → II(f, foot)";
    assert_structure(&l::jansen(), formula, &[RRR, RRR, RRR]);
}

#[test]
fn higher_classes() {
    let formula = "I(crank) → III(platform, first, second, third)";
    assert_structure(&l::triad(), formula, &[(3, 3, None)]);
    let formula = "I(crank) → IV(l234, l365, l48, l876, l95, l107)";
    assert_structure(&l::class_iv(), formula, &[(4, 3, None)]);
}

/// The class belongs to the mechanism with this driver (Artobolevsky).
#[test]
fn another_driver_another_class() {
    let formula = "I(l6) → III(crank, coupler, rocker, l5)";
    assert_structure(&l::stephenson("l6"), formula, &[(3, 3, None)]);
}

#[test]
fn redundant_third_bar() {
    let parallelogram = mechanism(&l::third_bar());
    let structure = parallelogram.structure();
    assert_eq!((structure.mobility, structure.mobility_counted), (1, 0));
    assert_eq!(structure.mobility_at_drawing, 1);
    assert_eq!(structure.redundant.links.len(), 1);
    assert_eq!(structure.class(), 2);
}

fn refused(description: &Description) -> StructureError {
    Mechanism::new(description).expect_err("no mechanism")
}

#[test]
fn wrong_names() {
    let bad = l::crank_rocker().link("extra", ["C", "X"]);
    assert!(matches!(refused(&bad), StructureError::Unknown { name, .. } if name == "X"));
    let bad = l::crank_rocker().joint("A", [9.0, 9.0]);
    assert!(matches!(refused(&bad), StructureError::DoubledName { name, .. } if name == "A"));
    let bad = l::crank_rocker().joint("a b", [9.0, 9.0]);
    assert!(matches!(refused(&bad), StructureError::BadName { .. }));
    let bad = l::crank_rocker().joint("X", [9.0, 9.0]);
    assert!(matches!(refused(&bad), StructureError::LooseJoint { joint } if joint == "X"));
    let bad = l::crank_rocker().driver("rokcer");
    assert!(
        matches!(refused(&bad), StructureError::Unknown { hint, .. } if hint.as_ref().is_some_and(|hint| hint.contains("rocker")))
    );
    let bad = l::crank_rocker().driver("crank");
    assert!(matches!(refused(&bad), StructureError::DoubledDriver { .. }));
    let bad = l::crank_rocker().driver("ground");
    assert!(matches!(refused(&bad), StructureError::GroundDriven { .. }));
    let bad = l::crank_rocker().assembly("Z", 1);
    assert!(matches!(refused(&bad), StructureError::Unknown { name, .. } if name == "Z"));
}

#[test]
fn wrong_numbers() {
    let bad = l::crank_rocker().joint("X", [f64::NAN, 0.0]).link("extra", ["C", "X"]);
    assert!(matches!(refused(&bad), StructureError::NotFinite { name, .. } if name == "X"));
    let bad = l::crank_rocker().joint("X", [4.1, 3.2]).link("extra", ["C", "X"]);
    assert!(matches!(refused(&bad), StructureError::ZeroLength { link, .. } if link == "extra"));
    let flat = Description::new()
        .joint("A", [0.0, 0.0])
        .joint("B", [1.0, 0.0])
        .joint("C", [4.0, 0.0])
        .joint("D", [2.0, 0.0])
        .link("ground", ["A", "D"])
        .link("crank", ["A", "B"])
        .link("coupler", ["B", "C"])
        .link("rocker", ["D", "C"])
        .driver("crank");
    let error = refused(&flat);
    assert!(matches!(&error, StructureError::FlatDyad { name, .. } if name == "C"), "{error}");
    assert!(Mechanism::new(&flat.clone().assembly("C", 1)).is_ok());
    assert!(matches!(refused(&flat.assembly("C", 2)), StructureError::BadSign { value: 2, .. }));
}

#[test]
fn wrong_mobility() {
    let under = refused(&l::five_bar(&["left"]));
    assert!(matches!(&under, StructureError::Mobility { mobility: 2, drivers: 1, .. }), "{under}");
    let doubled = refused(&l::five_bar(&["left"]).link("again", ["B", "C"]));
    let StructureError::Mobility { mobility: 2, counted: 1, free, overconstraint, .. } = doubled
    else {
        panic!("{doubled}");
    };
    let overconstraint = overconstraint.expect("one constraint too many");
    assert!(!free.is_empty() && overconstraint.links.iter().any(|name| name == "again"));
    let locked = refused(&l::crank_rocker().link("diagonal", ["A", "C"]));
    assert!(matches!(locked, StructureError::Immovable { counted: 0, .. }), "{locked}");
    let apart =
        Description::new().joint("E", [7.0, 0.0]).joint("F", [8.0, 0.0]).link("island", ["E", "F"]);
    let mut both = l::crank_rocker();
    both.joints.extend(apart.joints);
    both.links.extend(apart.links);
    assert!(matches!(refused(&both), StructureError::Unconnected { links } if links == ["island"]));
}

#[test]
fn wrong_slides() {
    let ppp = Description::new()
        .joint("A", [0.0, 0.0])
        .joint("B", [1.0, 0.0])
        .joint("C", [2.0, 1.0])
        .link("ground", ["A"])
        .link("first", ["B"])
        .link("second", ["C"])
        .slide("x", "first", "ground", 0.0, Some("A"))
        .slide("y", "second", "first", FRAC_PI_2, None)
        .slide("z", "second", "ground", PI / 4.0, None)
        .driver("x");
    assert!(matches!(refused(&ppp), StructureError::SlidesOnly { .. }));
    let nowhere = l::oldham().link("loose", []).slide("s", "loose", "shaft1", 0.1, None);
    assert!(matches!(refused(&nowhere), StructureError::GuideNowhere { .. }));
    let origin = l::oldham().slide("s", "shaft2", "shaft1", 0.1, Some("O2"));
    assert!(matches!(refused(&origin), StructureError::OriginNotOnLink { .. }));
    let same = l::oldham().slide("s", "disc", "disc", 0.1, None);
    assert!(matches!(refused(&same), StructureError::SameLink { .. }));
}
