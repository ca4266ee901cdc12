//! Hooks for tests and benches: a deliberate panic, to test how the library handles one, threads for
//! small work too, and the compilation of a tape by itself. Only the feature `test-hooks` has them,
//! which releases are built without.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use super::request::Outputs;
use crate::plan::compile_tape::Needs;
use crate::plan::mechanism::Mechanism;
use crate::plan::tape::Tape;
use crate::structure::closure::point_of_joint;

/// Chunks left until the panic; 0: no panic.
static CHUNKS: AtomicUsize = AtomicUsize::new(0);

/// Whether threads start at once.
static AT_ONCE: AtomicBool = AtomicBool::new(false);

/// Makes all later calls start their threads at once, even for little work.
pub fn start_threads_at_once(at_once: bool) {
    AT_ONCE.store(at_once, Ordering::SeqCst);
}

pub(crate) fn threads_start_at_once() -> bool {
    AT_ONCE.load(Ordering::SeqCst)
}

/// Makes the `number`-th chunk from now panic (0: none).
pub fn panic_in_chunk(number: usize) {
    CHUNKS.store(number, Ordering::SeqCst);
}

pub(crate) fn before_chunk() {
    let less = |left: usize| left.checked_sub(1);
    let before = CHUNKS.fetch_update(Ordering::SeqCst, Ordering::SeqCst, less);
    assert!(before != Ok(1), "deliberate panic");
}

/// Compiles the tape of a request for these joints and links; the number of its operations.
pub fn compile_tape(mechanism: &Mechanism, outputs: &Outputs) -> usize {
    let plan = mechanism.plan();
    let (mut points, mut classes) = (vec![false; plan.points], vec![false; plan.classes]);
    for &joint in &outputs.joints {
        points[point_of_joint(joint)] = true;
    }
    for &link in &outputs.links {
        classes[plan.rotation[link].class] = true;
    }
    Tape::new(plan, Needs { points: &points, classes: &classes, orientations: &[], samples: false })
        .ops
        .len()
}
