//! Remedies of drawings made by hand.

use super::*;

/// The offered remedies, each with its effect on the rest.
fn offered(description: &Description) -> Vec<String> {
    let offers = remedies(description, None).expect("not cancelled");
    for remedy in &offers {
        let mechanism = Mechanism::new(&remedy.description).expect("a remedy gives a mechanism");
        let structure = mechanism.structure();
        assert_eq!(structure.mobility, remedy.description.drivers.len(), "{}", remedy.text);
        assert_eq!(structure.mobility_at_drawing, structure.mobility, "{}", remedy.text);
    }
    offers.into_iter().map(|remedy| format!("{} — {}", remedy.text, remedy.detail)).collect()
}

fn four_bar() -> Description {
    Description::new()
        .joint("A", [0.0, 0.0])
        .joint("B", [1.0, 2.0])
        .joint("C", [5.0, 3.0])
        .joint("D", [6.0, 0.0])
        .link("ground", ["A", "D"])
        .link("crank", ["A", "B"])
        .link("coupler", ["B", "C"])
        .link("rocker", ["C", "D"])
        .driver("crank")
}

/// The mock of the studio: a four-bar whose coupler a brace holds.
fn braced() -> Description {
    let mut braced = four_bar().joint("E", [3.0, 1.5]).joint("F", [3.5, 0.0]);
    braced.links[0].1.push("F".into());
    braced.links[2].1.push("E".into());
    braced.link("brace", ["E", "F"])
}

fn three_joints() -> Description {
    Description::new().joint("A", [0.0, 0.0]).joint("B", [1.0, 2.0]).joint("C", [4.0, 2.5])
}

/// A crank and a link on it.
fn chain() -> Description {
    three_joints().link("ground", ["A"]).link("crank", ["A", "B"]).link("rod", ["B", "C"])
}

/// Two four-bars side by side; the second is not joined to anything.
fn twice() -> Description {
    four_bar()
        .joint("A2", [10.0, 0.0])
        .joint("B2", [10.0, 1.0])
        .joint("C2", [13.0, 2.0])
        .joint("D2", [14.0, 0.0])
        .link("crank2", ["A2", "B2"])
        .link("coupler2", ["B2", "C2"])
        .link("rocker2", ["C2", "D2"])
}

#[test]
fn a_brace_slides_or_goes_or_becomes_two_links() {
    let expected = [
        "Let F slide on the ground — brace stays, its foot follows",
        "Take out brace — crank, coupler and rocker remain",
        "Add a link between E and brace — two links in place of one",
    ];
    assert_eq!(offered(&braced()), expected);
}

#[test]
fn only_the_brace_slides_where_others_are_pinned_too() {
    let offers = remedies(&four_bar().link("brace", ["A", "C"]), None).expect("not cancelled");
    assert_eq!(offers[0].text, "Let brace slide on the ground at A");
    let links = &offers[0].description.links;
    assert_eq!(links[0].1, ["A", "D"]);
    assert_eq!(links[1].1, ["A", "B"]);
    assert_eq!(links[4].1, ["E", "C"]);
    assert_eq!(links[5], ("E_block".into(), vec!["E".into()]));
}

#[test]
fn a_triangle_becomes_a_slider_crank() {
    let truss =
        three_joints().link("ground", ["A", "C"]).link("crank", ["A", "B"]).link("rod", ["B", "C"]);
    let expected = [
        "Let C slide on the ground — rod stays, its foot follows",
        "Take out rod — crank remains",
        "Add a link between B and rod — two links in place of one",
    ];
    assert_eq!(offered(&truss.clone().driver("crank")), expected);
    // Without a driver one is chosen.
    assert_eq!(offered(&truss), expected);
}

#[test]
fn two_braces_go_together() {
    let held = four_bar().link("b1", ["A", "C"]).link("b2", ["B", "D"]);
    assert_eq!(offered(&held), ["Take out b2 and b1 — crank, coupler and rocker remain"]);
}

/// Parallelograms in a row, each rocker the next one's crank.
fn row(stages: u32) -> Description {
    let mut row = Description::new()
        .joint("A", [0.0, 0.0])
        .joint("B", [0.3, 1.0])
        .link("ground", ["A"])
        .link("crank", ["A", "B"])
        .driver("crank");
    let mut pin = "B".to_owned();
    for k in 0..stages {
        let x = 2.0 * f64::from(k + 1);
        let (knee, foot) = (format!("C{k}"), format!("D{k}"));
        row = row.joint(&knee, [x + 0.3, 1.0]).joint(&foot, [x, 0.0]);
        row.links[0].1.push(foot.clone());
        row = row
            .link(&format!("coupler{k}"), [&pin[..], &knee])
            .link(&format!("rocker{k}"), [&foot[..], &knee]);
        pin = knee;
    }
    row
}

#[test]
fn in_many_links_only_those_that_hold_the_driver_are_tried() {
    // The brace of the first stage is drawn first; no link behind that stage holds it.
    let mut held = row(40);
    held.links.insert(1, ("brace".into(), vec!["A".into(), "C0".into()]));
    let linkage = crate::description::Linkage::new(&held).expect("valid");
    let holding = crate::structure::holding_drivers(&linkage, None).expect("ranks");
    assert_eq!(holding, ["brace", "crank", "coupler0", "rocker0"]);
    // The brace then guides C0 in place of the rocker.
    assert_eq!(offered(&held)[1], "Take out rocker0 — the other 81 links remain");
}

#[test]
fn what_hangs_is_joined_guided_or_driven() {
    let expected = [
        "Add a link between C and the ground — it turns about a new fixed joint D",
        "Let C slide on the ground — a block on a guide, pinned to rod",
        "Drive rod too — two drivers for mobility 2",
    ];
    assert_eq!(offered(&chain().driver("crank")), expected);
    let mut without_rocker = four_bar();
    without_rocker.links.truncate(3);
    assert_eq!(
        offered(&without_rocker)[0],
        "Add a link between C and D — it turns about D on the ground"
    );
}

#[test]
fn a_piston_gets_its_guide() {
    let engine = chain().link("piston", ["C"]).driver("crank");
    let expected = [
        "Let piston slide on the ground — along a guide through C",
        "Drive rod and piston too — three drivers for mobility 3",
        "Take out piston and rod — crank remains",
    ];
    assert_eq!(offered(&engine), expected);
}

#[test]
fn an_end_is_held_where_two_freedoms_are_left() {
    let mut open = four_bar();
    open.links[0].1.pop();
    assert_eq!(offered(&open)[0], "Hold D on the ground — rocker turns about it");
}

#[test]
fn a_five_bar_gets_a_second_driver() {
    let five = Description::new()
        .joint("A", [0.0, 0.0])
        .joint("B", [0.0, 1.0])
        .joint("C", [2.0, 2.0])
        .joint("D", [3.0, 1.0])
        .joint("E", [3.0, 0.0])
        .link("ground", ["A", "E"])
        .link("left", ["A", "B"])
        .link("l2", ["B", "C"])
        .link("l3", ["C", "D"])
        .link("right", ["D", "E"]);
    let expected = [
        "Drive right too — two drivers for mobility 2",
        "Add a link between D and the ground — it turns about a new fixed joint F",
        "Add a link between C and the ground — it turns about a new fixed joint F",
    ];
    assert_eq!(offered(&five.driver("left")), expected);
}

#[test]
fn drivers_are_found_replaced_and_left_out() {
    let expected = ["Drive crank", "Drive rocker", "Drive coupler"];
    let undriven = Description { drivers: Vec::new(), ..four_bar() };
    let held = "with it held, nothing moves";
    assert_eq!(offered(&undriven), expected.map(|text| format!("{text} — {held}")));
    let expected = [
        "Leave rocker undriven — crank drives alone",
        "Leave crank undriven — rocker drives alone",
    ];
    assert_eq!(offered(&four_bar().driver("rocker")), expected);
    for (name, first) in [("crnk", "Drive crank"), ("ground", "Drive crank")] {
        let wrong = undriven.clone().driver(name);
        let expected =
            format!("{first} instead of {name} — with what is driven held, nothing moves");
        assert_eq!(offered(&wrong)[0], expected);
    }
    let engine = chain().link("piston", ["C"]).slide("bore", "piston", "ground", 0.0, Some("A"));
    let offers = remedies(&engine.driver("piston"), None).expect("not cancelled");
    let texts: Vec<&str> = offers.iter().map(|remedy| remedy.text.as_str()).collect();
    assert_eq!(texts[..2], ["Drive crank instead of piston", "Drive bore instead of piston"]);
}

#[test]
fn what_is_joined_to_nothing_is_held_or_goes() {
    let expected = "Take out crank2, coupler2 and rocker2 — crank, coupler and rocker remain";
    assert_eq!(offered(&twice()), [expected]);
    let afloat = four_bar().joint("Q", [9.0, 9.0]).joint("R", [1.0, 9.0]).link("x", ["Q", "R"]);
    assert_eq!(offered(&afloat), ["Take out x — crank, coupler and rocker remain"]);
    let mut afloat = four_bar();
    afloat.links[0].1.clear();
    assert_eq!(offered(&afloat), ["Hold A and D on the ground — crank and rocker turn about them"]);
    let loose = four_bar().joint("P", [2.0, 4.0]);
    let expected = [
        "Fix P to crank — it moves with the link, as a point of it",
        "Fix P to coupler — it moves with the link, as a point of it",
        "Take out P — it is on no link",
    ];
    assert_eq!(offered(&loose), expected);
}

#[test]
fn the_second_of_two_four_bars_is_driven() {
    let mut both = twice();
    both.links[0].1.extend(["A2".into(), "D2".into()]);
    assert_eq!(offered(&both)[0], "Drive crank2 too — two drivers for mobility 2");
    let offers = remedies(&both.driver("rocker"), None).expect("not cancelled");
    assert_eq!(offers[0].text, "Drive crank2 instead of rocker");
}

#[test]
fn nothing_is_offered_where_nothing_is_wrong_or_names_are() {
    assert!(offered(&four_bar()).is_empty());
    assert!(offered(&four_bar().link("a b", ["A", "C"])).is_empty());
    assert!(offered(&Description::new()).is_empty());
}

#[test]
fn it_can_be_cancelled() {
    let cancel = AtomicBool::new(true);
    let result = remedies(&braced(), Some(&cancel));
    assert_eq!(result.err(), Some(StructureError::Interrupted));
}
