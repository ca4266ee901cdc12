//! Names near to a misspelt one.

/// `; did you mean …?` with the (at most three) nearest of `known`, or the
/// whole list if it is short, or nothing.
#[must_use]
pub(crate) fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    let mut ranked: Vec<(usize, &str)> = known.map(|k| (distance(name, k), k)).collect();
    ranked.sort_unstable();
    if ranked.is_empty() {
        return String::new();
    }
    let limit = name.chars().count().div_ceil(2).max(2);
    let near: Vec<String> =
        ranked.iter().take(3).filter(|(d, _)| *d <= limit).map(|(_, k)| format!("{k:?}")).collect();
    if !near.is_empty() {
        return format!("; did you mean {}?", near.join(" or "));
    }
    let some: Vec<String> = ranked.iter().take(12).map(|(_, k)| format!("{k:?}")).collect();
    format!("; there are {}{}", some.join(", "), if ranked.len() > 12 { " …" } else { "" })
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
    fn distances_of_textbook_words() {
        assert_eq!(distance("kitten", "sitting"), 3);
        assert_eq!(distance("Crank", "crank"), 0);
        assert_eq!(distance("", "ab"), 2);
    }

    #[test]
    fn nearest_names_come_first() {
        let hint = nearest("cuopler.length", ["coupler.length", "rocker.length"].into_iter());
        assert!(hint.starts_with("; did you mean \"coupler.length\""), "{hint}");
    }
}
