//! Names in sentences.

/// Most names that are listed one by one; for more, their number is given.
const FEW: usize = 4;

/// `a`, `a and b`, `a, b and c`.
pub(super) fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [name] => name.clone(),
        [earlier @ .., last] => format!("{} and {last}", earlier.join(", ")),
    }
}

/// The links that remain, as a sentence.
pub(super) fn remaining(links: &[String]) -> String {
    match links {
        [] => "nothing else is drawn".into(),
        [name] => format!("{name} remains"),
        few if few.len() <= FEW => format!("{} remain", listed(few)),
        several => format!("the other {} links remain", several.len()),
    }
}

/// A small number in words.
pub(super) fn in_words(count: usize) -> String {
    const WORDS: [&str; 7] = ["no", "one", "two", "three", "four", "five", "six"];
    WORDS.get(count).map_or_else(|| count.to_string(), ToString::to_string)
}
