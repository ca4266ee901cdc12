//! Suggestions for misspelt and mistaken names.

use super::error::Named;

/// Advice on an unknown name: "did you mean …?" with up to three names about as similar as the
/// nearest, else the first twelve of `candidates` in order of distance. `None` if `candidates` is empty.
#[must_use]
pub(crate) fn suggest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<String> {
    let mut ranked: Vec<(usize, &str)> = candidates.map(|k| (distance(name, k), k)).collect();
    ranked.sort_unstable();
    let &(nearest, _) = ranked.first()?;
    // More than half of a similar name is the same, and swapped letters count twice.
    let limit = (nearest + 1).min(name.chars().count() / 2);
    let similar: Vec<String> =
        ranked.iter().take(3).filter(|(d, _)| *d <= limit).map(|(_, k)| format!("{k:?}")).collect();
    if !similar.is_empty() {
        return Some(format!("did you mean {}?", similar.join(" or ")));
    }
    let first: Vec<String> = ranked.iter().take(12).map(|(_, k)| format!("{k:?}")).collect();
    if let [only] = &first[..] {
        return Some(format!("there is only {only}"));
    }
    let more = if ranked.len() > first.len() { ", …" } else { "" };
    Some(format!("there are {}{more}", first.join(", ")))
}

/// Advice on a joint given for a link, or a link given for a joint.
#[must_use]
pub(crate) fn mistaken_kind(name: &str, expected: Named, actual: Named) -> Option<String> {
    match (expected, actual) {
        (Named::Link, Named::Joint) => Some(format!(
            "{name:?} is a joint: name a link that has it, or give it a link of its own, links={{\"block\": [{name:?}]}}"
        )),
        (Named::Joint, Named::Link) => Some(format!(
            "{name:?} is a link: name a joint of it, or a point on it, ({name:?}, (x, y))"
        )),
        _ => None,
    }
}

/// Levenshtein distance (Wagner and Fischer 1974), case ignored.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.to_lowercase().chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.to_lowercase().chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &cb) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(ca != cb);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_of_textbook_words() {
        assert_eq!(distance("kitten", "sitting"), 3);
        assert_eq!(distance("Crank", "crank"), 0);
        assert_eq!(distance("", "ab"), 2);
    }

    #[test]
    fn similar_names_come_first() {
        let hint = suggest("cuopler.length", ["coupler.length", "rocker.length"].into_iter());
        let hint = hint.expect("two names are known");
        assert_eq!(hint, "did you mean \"coupler.length\"?");
    }

    #[test]
    fn names_that_are_not_similar_are_listed() {
        let hint = |names: &[&'static str]| suggest("Z", names.iter().copied());
        assert_eq!(hint(&["B", "A"]).as_deref(), Some("there are \"A\", \"B\""));
        assert_eq!(hint(&["C"]).as_deref(), Some("there is only \"C\""));
        assert_eq!(hint(&[]), None);
    }
}
