//! Suggestions for misspelt names.

/// The end of a message about an unknown name: `; did you mean …?` with up to three similar
/// names, else the first twelve of `known` in order of distance. Empty if `known` is.
#[must_use]
pub(crate) fn suggest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    let mut ranked: Vec<(usize, &str)> = known.map(|k| (distance(name, k), k)).collect();
    ranked.sort_unstable();
    if ranked.is_empty() {
        return String::new();
    }
    let limit = name.chars().count().div_ceil(2).max(2);
    let similar: Vec<String> =
        ranked.iter().take(3).filter(|(d, _)| *d <= limit).map(|(_, k)| format!("{k:?}")).collect();
    if !similar.is_empty() {
        return format!("; did you mean {}?", similar.join(" or "));
    }
    let first: Vec<String> = ranked.iter().take(12).map(|(_, k)| format!("{k:?}")).collect();
    format!("; there are {}{}", first.join(", "), if ranked.len() > 12 { " …" } else { "" })
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
        assert!(hint.starts_with("; did you mean \"coupler.length\""), "{hint}");
    }
}
