//! Names in sentences.

/// Names that are listed one by one; of more, how many there are.
const FEW: usize = 4;

/// `a`, `a and b`, `a, b and c`.
pub(super) fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    }
}

/// The links that remain, as a sentence.
pub(super) fn remaining(links: &[String]) -> String {
    match links {
        [] => "nothing else is drawn".into(),
        [one] => format!("{one} remains"),
        few if few.len() <= FEW => format!("{} remain", listed(few)),
        many => format!("the other {} links remain", many.len()),
    }
}

/// A small number in words.
pub(super) fn in_words(count: usize) -> String {
    const WORDS: [&str; 7] = ["no", "one", "two", "three", "four", "five", "six"];
    WORDS.get(count).map_or_else(|| count.to_string(), ToString::to_string)
}
