//! Linkages put together from parts: what the structure says against counts made here.

use std::collections::HashSet;

use arbitrary::Unstructured;
use assur::{Description, Driver, Linkage, Mechanism};

use super::{Shown, check_sentence, grammar};

/// Refused with a sentence, or a sound structure.
pub fn structure(data: &[u8]) {
    let Ok(description) = grammar::linkage(&mut Unstructured::new(data)) else { return };
    let _shown = Shown(&description);
    match Mechanism::new(&description) {
        Ok(mechanism) => check(&mechanism, &description),
        Err(error) => check_sentence(&error.to_string()),
    }
}

/// Everything a mechanism says about its structure.
pub fn check(mechanism: &Mechanism, description: &Description) {
    let (linkage, structure) = (mechanism.linkage(), mechanism.structure());
    assert_eq!(structure.mobility, linkage.drivers.len(), "mobility and drivers");
    check_groups(mechanism);
    check_formula(mechanism);
    check_counts(mechanism);
    check_numbers(mechanism);
    assert_eq!(Mechanism::new(description).as_ref(), Ok(mechanism), "built again");
}

/// Every link that moves and is needed is in one group; the driven ones may be in none.
fn check_groups(mechanism: &Mechanism) {
    let (linkage, structure) = (mechanism.linkage(), mechanism.structure());
    let driven: HashSet<usize> =
        linkage.drivers.iter().flat_map(|&driver| ends(linkage, driver)).collect();
    for link in 0..linkage.links.len() {
        let groups = structure.groups.iter().filter(|g| g.links.contains(&link)).count();
        let spare = link == linkage.ground || structure.redundant.links.contains(&link);
        let name = &linkage.links[link].name;
        if spare {
            assert_eq!(groups, 0, "{name} is in {groups} groups");
        } else if driven.contains(&link) {
            assert!(groups <= 1, "{name} is in {groups} groups");
        } else {
            assert_eq!(groups, 1, "{name} is in {groups} groups");
        }
    }
    for group in &structure.groups {
        assert!(group.class >= 2 && !group.links.is_empty(), "{group:?}");
        assert!(group.kind.is_none() || group.class == 2, "{group:?}");
    }
}

/// The formula names the drivers, then every group's links.
fn check_formula(mechanism: &Mechanism) {
    let (linkage, structure) = (mechanism.linkage(), mechanism.structure());
    let formula = structure.formula();
    let groups: Vec<&str> = formula.split(" → ").collect();
    assert!(groups[0].starts_with("I(") && groups[0].ends_with(')'), "{formula}");
    assert_eq!(groups.len(), 1 + structure.groups.len(), "{formula}");
    for (text, group) in groups[1..].iter().zip(&structure.groups) {
        let names: Vec<&str> =
            group.links.iter().map(|&l| linkage.links[l].name.as_str()).collect();
        assert!(text.ends_with(&format!("({})", names.join(", "))), "{formula}: {names:?}");
    }
}

/// 3 n − 2 p (Chebyshev 1870, Grübler 1883) of the whole and of every group.
fn check_counts(mechanism: &Mechanism) {
    let (linkage, structure) = (mechanism.linkage(), mechanism.structure());
    let redundant = &structure.redundant;
    let ground = [linkage.ground];
    let moving: Vec<usize> =
        (0..linkage.links.len()).filter(|&link| link != linkage.ground).collect();
    let all: Vec<usize> = (0..linkage.slides.len()).collect();
    let counted = freedoms(linkage, &all, &moving, &ground);
    assert_eq!(counted, structure.mobility_counted, "with redundant parts");
    let moving: Vec<usize> =
        moving.into_iter().filter(|link| !redundant.links.contains(link)).collect();
    let slides: Vec<usize> =
        all.into_iter().filter(|&slide| !redundant.has_slide(linkage, slide)).collect();
    let counted = freedoms(linkage, &slides, &moving, &ground);
    assert_eq!(usize::try_from(counted), Ok(structure.mobility), "of the whole");
    // Where every driver locks a link to the ground the groups close one after another.
    let mut before = ground.to_vec();
    for &driver in &linkage.drivers {
        let [a, b] = ends(linkage, driver);
        let joined = matches!(driver, Driver::Slide(_))
            || linkage.links[a].joints.iter().any(|j| linkage.links[b].joints.contains(j));
        match (a == linkage.ground, b == linkage.ground) {
            (false, true) if joined => before.push(a),
            (true, false) if joined => before.push(b),
            _ => return,
        }
    }
    for group in &structure.groups {
        let counted = freedoms(linkage, &slides, &group.links, &before);
        assert_eq!(counted, 0, "{group:?} after {before:?}");
        before.extend(&group.links);
    }
}

/// Freedoms of links that hang on others: 3 each, less 2 a pair.
fn freedoms(linkage: &Linkage, slides: &[usize], links: &[usize], before: &[usize]) -> i64 {
    let mut pairs = 0;
    for joint in 0..linkage.joints.len() {
        let on = |set: &[usize]| {
            set.iter().filter(|&&l| linkage.links[l].joints.contains(&joint)).count()
        };
        pairs += (on(links) + on(before).min(1)).saturating_sub(1);
    }
    for &slide in slides {
        let ends = [linkage.slides[slide].link, linkage.slides[slide].on];
        let inside = ends.iter().filter(|l| links.contains(l)).count();
        let known = ends.iter().filter(|l| before.contains(l)).count();
        pairs += usize::from(inside > 0 && inside + known == 2);
    }
    let count = |n: usize| i64::try_from(n).expect("few links");
    3 * count(links.len()) - 2 * count(pairs)
}

/// The two links that a driver relates.
fn ends(linkage: &Linkage, driver: Driver) -> [usize; 2] {
    match driver {
        Driver::Slide(slide) => [linkage.slides[slide].link, linkage.slides[slide].on],
        Driver::Angle { link, relative_to } => [link, relative_to],
    }
}

/// As many numbers as names, and every name once.
fn check_numbers(mechanism: &Mechanism) {
    let names: Vec<&str> = mechanism.dimensions().iter().map(|(name, _)| name).collect();
    let different: HashSet<&str> = names.iter().copied().collect();
    assert_eq!(different.len(), names.len(), "{names:?}");
    assert_eq!(mechanism.drawing().len(), names.len());
    assert!(mechanism.drawing().iter().all(|x| x.is_finite()), "{:?}", mechanism.drawing());
    assert_eq!(mechanism.q0().len(), mechanism.linkage().drivers.len());
    assert!(mechanism.q0().iter().all(|q| q.is_finite()), "{:?}", mechanism.q0());
    assert_eq!(mechanism.signs().len(), mechanism.dyad_names().len());
    assert!(mechanism.signs().iter().all(|&sign| sign == 1 || sign == -1));
}
