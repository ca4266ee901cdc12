//! Solves many designs at many positions into arrays, in blocks of lanes and on all cores.
pub mod bench_hooks;
mod by_position;
mod checked;
pub(crate) mod chunks;
mod coordinates;
pub(crate) mod dispatch;
pub(crate) mod failure_log;
pub(crate) mod helpers;
pub(crate) mod known_signs;
pub(crate) mod motion;
pub(crate) mod request;
pub(crate) mod rows;
pub(crate) mod schedule;
pub(crate) mod scratch;
pub(crate) mod solve;
#[cfg(feature = "test-hooks")]
pub mod test_hooks;
pub(crate) mod turns;
mod unchecked;
mod work_space;
pub(crate) mod worker;
pub(crate) mod writer;
