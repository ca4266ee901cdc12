//! What the fuzzer's bytes mean, and what must hold for every input.
//!
//! `description`, `structure` and `solve` are the bodies of the libFuzzer targets in `fuzz/`;
//! `replay` runs them over the corpus, so that `cargo test` needs no fuzzer.

mod closures;
pub mod description;
mod grammar;
#[cfg(test)]
mod replay;
mod request;
pub mod solve;
pub mod structure;

use std::fmt::Debug;

/// Shows what the input of a failed check means.
struct Shown<'a, T: Debug>(&'a T);

impl<T: Debug> Drop for Shown<'_, T> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            eprintln!("{:?}", self.0);
        }
    }
}

/// Longest sentence of an error: one that lists some thirty links twice.
const LONGEST_SENTENCE: usize = 4000;

/// A sentence that can be shown: not empty, not endless.
fn check_sentence(sentence: &str) {
    assert!(!sentence.trim().is_empty(), "an error without a sentence");
    assert!(sentence.len() <= LONGEST_SENTENCE, "{} bytes: {sentence}", sentence.len());
}
