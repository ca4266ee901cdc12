//! The fuzzing corpus and every input that found a fault, run again.

use std::path::Path;

use super::{description, solve, structure};

/// Inputs of every target, at least: fewer are not the corpus.
const LEAST: usize = 20;

/// Runs every file of a target's corpus and of its regressions.
fn replay(name: &str, target: fn(&[u8])) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz");
    let mut inputs = 0;
    for folder in ["corpus", "regressions"] {
        // A target without a regression has no folder there.
        let Ok(files) = root.join(folder).join(name).read_dir() else { continue };
        for file in files {
            let path = file.expect("a file of the corpus").path();
            // The last one printed is the one that fails.
            println!("{}", path.display());
            target(&std::fs::read(&path).expect("an input that can be read"));
            inputs += usize::from(folder == "corpus");
        }
    }
    assert!(inputs >= LEAST, "{inputs} inputs in fuzz/corpus/{name}: the corpus is missing");
}

#[test]
fn descriptions_are_refused_or_sound() {
    replay("description", description::description);
}

#[test]
fn structures_add_up() {
    replay("structure", structure::structure);
}

#[test]
fn solved_positions_close_and_have_their_own_bits() {
    replay("solve", solve::solve);
}
