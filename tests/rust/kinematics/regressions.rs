//! Drawings that broke a bound once, found by the random tests: kept by hand.

use std::f64::consts::FRAC_PI_2;

use assur::{Description, Mechanism, StructureError};

use crate::oracles::body::Oracle;
use crate::oracles::law::compare;

/// The bounds at steps from the drawing.
fn assert_bounds(description: &Description, steps: &[f64]) {
    let mechanism = Mechanism::new(description).unwrap_or_else(|error| panic!("{error}"));
    let oracle = Oracle::new(description);
    for step in steps {
        let q = [mechanism.q0()[0] + step];
        let mut at = oracle.follow(oracle.drawing(), &q).expect("no fold this near");
        let worst = compare(&mechanism, &oracle, &mut at, &q);
        assert!(worst.ratio.iter().all(|&r| r <= 1.0), "{worst:?} at {q:?}");
    }
}

/// Two guides whose pivots come within a twelfth of the size: a condition that
/// knew only the angle between the legs promised too much of the third analogue.
#[test]
fn guides_with_short_arms() {
    let linkage = Description::new()
        .joint("J0", [0.4291880633634224, -0.8005139180718877])
        .joint("J1", [-0.7156737483749704, -2.183052870038539])
        .joint("J2", [-2.2983123555276648, -3.5347553859863234])
        .joint("J3", [-2.405804320408271, -6.080027578461609])
        .joint("J4", [-2.5366922746934786, -3.763730392365035])
        .joint("J5", [-2.350524287413851, -3.5016112963350214])
        .joint("J6", [-1.4468546746898818, -2.9154642878564077])
        .link("ground", ["J0", "J6", "J3"])
        .link("L1", ["J0", "J5", "J1"])
        .link("L2", ["J1", "J2"])
        .link("L3", ["J2", "J4", "J3"])
        .link("L4", ["J4"])
        .link("L5", ["J5"])
        .link("L6", ["J1"])
        .link("L7", ["J6"])
        .slide("s0", "L5", "L4", 2.439900160102153, Some("J4"))
        .slide("s1", "L7", "L6", -2.884732130542593, None)
        .drive("L2", "L1");
    assert_bounds(&linkage, &[0.0, 0.10740126096]);
}

/// A short cylinder that carries a far slide.
#[test]
fn far_slide_on_a_short_cylinder() {
    let linkage = Description::new()
        .joint("J0", [-0.9195246038031903, 1.0781690223233187])
        .joint("J1", [-0.6954235077921753, 1.2953806043178988])
        .joint("J2", [1.8593259312944084, 1.6721603812155754])
        .link("ground", ["J0", "J2"])
        .link("L1", ["J0"])
        .link("L2", ["J1"])
        .link("L3", ["J2", "J1"])
        .link("L4", ["J2"])
        .link("L5", [])
        .slide("s0", "L1", "L2", -2.6866498776925503, None)
        .slide("s1", "L5", "L2", -2.8407456557085884, Some("J1"))
        .slide("s2", "L5", "L4", 2.6634415370059483, Some("J2"))
        .driver("s0");
    assert_bounds(&linkage, &[0.0]);
}

/// A guide that hardly turns: the second analogue is what is left of products of
/// first ones that are forty times as large.
#[test]
fn guide_nearly_along_the_motion() {
    let linkage = Description::new()
        .joint("J0", [1.0341878884372808, 1.9533469785145812])
        .joint("J1", [2.4003129055130064, 0.563155906179337])
        .joint("J2", [2.4003129055130064, -0.8722128183087101])
        .link("ground", ["J1"])
        .link("L1", ["J2", "J0"])
        .link("L2", ["J1"])
        .link("L3", ["J2"])
        .slide("s0", "L1", "ground", -2.671399708384888, None)
        .slide("s1", "L2", "L3", -2.6684362552305707, Some("J2"))
        .driver("s0");
    assert_bounds(&linkage, &[0.0, 0.13497317816743679]);
}

/// A link without joints is placed where its first two guides cross; here these
/// are 1° from parallel (a third crosses both well), and the point is forty sizes
/// away.
#[test]
fn link_placed_by_nearly_parallel_guides() {
    let linkage = Description::new()
        .joint("J0", [-1.4061478200110704, -1.3500279938207287])
        .joint("J1", [-1.4061478200110702, -4.102437237883615])
        .joint("J2", [-1.6164385364218568, -1.6490621749075496])
        .joint("J3", [-1.6809690911396669, -2.878445415986938])
        .link("ground", ["J0"])
        .link("L1", ["J0", "J1", "J2"])
        .link("L2", ["J2"])
        .link("L3", [])
        .link("L4", ["J3"])
        .link("L5", ["J3"])
        .slide("s0", "L3", "ground", 2.6505878263781355, Some("J0"))
        .slide("s2", "L3", "L4", -0.47288726583026347, Some("J3"))
        .slide("s3", "L5", "L1", 1.5925671960835264, Some("J0"))
        .slide("s1", "L3", "L2", 2.9927959909832773, Some("J2"))
        .driver("L1");
    assert_bounds(&linkage, &[0.0]);
}

/// A rate of 148 at the drawing: angles followed in steps too long slip by a turn.
#[test]
fn coupler_near_its_dead_point() {
    let linkage = Description::new()
        .joint("J0", [0.4354707143711698, 0.14563822902229528])
        .joint("J1", [0.9840679640814948, 0.14563822902229528])
        .joint("J2", [0.9840679640814949, -2.180448166718528])
        .joint("J3", [-1.662681790302386, -1.7099759814566626])
        .joint("J4", [0.9840679640814949, -2.6070309402777436])
        .link("ground", ["J0", "J3"])
        .link("L1", ["J0", "J1", "J4"])
        .link("L2", ["J2", "J1"])
        .link("L3", ["J2", "J3"])
        .link("L4", ["J2"])
        .link("L5", ["J4"])
        .slide("s0", "L5", "L4", 2.6998880648846555, None)
        .driver("L2");
    assert_bounds(&linkage, &[0.0, 1.7647722549301197 - FRAC_PI_2]);
}

/// A crank drawn at its dead point drives on one side of it: the drawing is flat,
/// the mechanism is one.
#[test]
fn crank_drawn_at_its_dead_point() {
    let linkage = Description::new()
        .joint("A", [0.0, 0.0])
        .joint("B", [1.0, 1.0])
        .joint("C", [3.0, 0.5])
        .joint("D", [5.0, 0.0])
        .link("ground", ["A", "D"])
        .link("crank", ["A", "B"])
        .link("coupler", ["B", "C"])
        .link("rocker", ["D", "C"])
        .driver("crank");
    let error = Mechanism::new(&linkage).expect_err("no side is drawn");
    assert!(matches!(&error, StructureError::FlatDyad { name, .. } if name == "C"), "{error}");
    let named = Mechanism::new(&linkage.assembly("C", 1));
    assert!(named.is_ok(), "{named:?}");
}

/// The third analogue of a guide whose pivots are a third of the size apart.
#[test]
fn third_analogue_of_a_guide() {
    let linkage = Description::new()
        .joint("J0", [-2.0, -2.0])
        .joint("J1", [-2.3, -2.0])
        .joint("J2", [-0.9022808876860997, -1.0999954497398154])
        .joint("J3", [-0.9022808876860997, -0.6291973386885243])
        .link("ground", ["J2", "J0"])
        .link("L1", ["J0", "J1", "J3"])
        .link("L2", ["J2"])
        .link("L3", ["J3"])
        .slide("s0", "L2", "L3", -0.7647151453865852, Some("J3"))
        .driver("L1");
    assert_bounds(&linkage, &[0.01]);
}

/// A short rod on a long link with its block on the crank.
#[test]
fn position_of_a_short_rod() {
    let linkage = Description::new()
        .joint("J0", [-0.3198745679272663, -2.0])
        .joint("J1", [0.6651107688765014, -1.7490073494006766])
        .joint("J2", [-0.9659782968431766, -2.112512322003571])
        .joint("J3", [-0.7892694658423416, -1.7250346507608767])
        .joint("J4", [-1.9450181910717563, -4.286976764868248])
        .joint("J5", [-3.21125473528392, -3.332332196635937])
        .link("L1", ["J1", "J0"])
        .link("L2", ["J2", "J4", "J3"])
        .link("L3", ["J5", "J3"])
        .link("ground", ["J2", "J0"])
        .slide("s0", "L3", "L1", -0.5121762056554706, Some("J0"))
        .driver("L1");
    assert_bounds(&linkage, &[0.22041186363970888]);
}
