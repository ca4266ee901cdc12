//! Criterion benches of the core: `cargo bench`, or `make bench`.

use criterion::Criterion;

fn main() {
    let criterion = Criterion::default().configure_from_args();
    criterion.final_summary();
}
