//! One position of the core against the oracle.
//!
//! The law (docs/reference/conventions.md): a position is good to 8 u κ of the size, an
//! analogue to 64 u κ² of its own size. κ is the condition the core states. Here
//!
//! - the size is the greatest coordinate at the position ([`Oracle::extent`]);
//! - an angle counts by what it displaces: times its arm ([`Oracle::arms`]);
//! - the own size of an order is the norm over all outputs; where the order
//!   vanishes altogether (translations) the products of the errors of the first
//!   order remain, k of them for order k.

use assur::tolerance::{ANALOGUE_PER_CONDITION_SQUARED, CLOSURE_PER_CONDITION};
use assur::{Coordinates, Mechanism, Motion, Outputs, Request, Series, Status};

use crate::oracles::body::{Oracle, Position};
use crate::oracles::double_double::Dd;
use crate::oracles::series::ORDER;

/// What one position came out as, against its bounds (1: just met).
#[derive(Debug, Clone, Copy, Default)]
pub struct Worst {
    pub ratio: [f64; ORDER + 1],
    pub condition: f64,
}

/// The core's numbers of one order against the oracle's.
struct Comparison<'a> {
    oracle: &'a Oracle,
    at: &'a Position,
    drivers: usize,
    /// Arm of every link, see [`Oracle::arms`].
    arms: Vec<f64>,
}

impl Comparison<'_> {
    /// Driver indices of every entry of an order's tensor, last fastest.
    fn indices(&self, order: usize) -> Vec<Vec<usize>> {
        let mut all = vec![Vec::new()];
        for _ in 0..order {
            all = (all.iter())
                .flat_map(|head| (0..self.drivers).map(move |d| [&head[..], &[d]].concat()))
                .collect();
        }
        all
    }

    /// Greatest difference and sum of squares over one track, lengths as parts of
    /// the size; `series` gives a component's coefficient.
    fn track(
        &self,
        track: &Series,
        order: usize,
        length: bool,
        components: usize,
        series: impl Fn(usize, usize) -> Dd,
    ) -> (f64, f64) {
        let indices = self.indices(order);
        let values = &track.derivatives[order];
        assert_eq!(values.len(), components * indices.len(), "entries of order {order}");
        let unit = if length { self.oracle.size } else { 1.0 };
        let (mut worst, mut squares) = (0.0_f64, 0.0);
        for component in 0..components {
            for (index, drivers) in indices.iter().enumerate() {
                let (k, factor) = self.oracle.tables.partial(drivers);
                let scale: f64 = drivers.iter().map(|&d| self.oracle.unit[d]).product();
                let value = values[component * indices.len() + index] / unit * scale;
                let expected = series(component, k) * Dd::from(factor);
                let error = f64::from(Dd::from(value) - expected).abs();
                // NaN must not be lost in a maximum.
                worst = if error.is_nan() { f64::INFINITY } else { worst.max(error) };
                squares += f64::from(expected).powi(2);
            }
        }
        (worst, squares)
    }

    /// Greatest difference and size (norm over all outputs) of one order.
    fn order(&self, motion: &Motion, order: usize) -> (f64, f64) {
        let (oracle, at) = (self.oracle, self.at);
        let mut parts = Vec::new();
        for t in &motion.joints {
            let (body, u) = oracle.joints[t.index];
            parts.push(self.track(t, order, true, 2, |c, k| at.point(body, u, k)[c]));
        }
        for t in &motion.origins {
            let body = &at.bodies[t.index];
            if t.index != oracle.ground {
                parts.push(self.track(t, order, true, 2, |c, k| [body.x[k], body.y[k]][c]));
            }
        }
        for t in &motion.links {
            let drawn = oracle.angle0[t.index];
            let (worst, squares) = self.track(t, order, false, 1, |_, k| {
                let turned = at.bodies[t.index].turn[k];
                if k == 0 { turned + drawn } else { turned }
            });
            let reach = self.arms[t.index];
            parts.push((worst * reach, squares * reach * reach));
        }
        for t in &motion.slides {
            let value = &oracle.values[t.index];
            parts.push(self.track(t, order, true, 1, |_, k| oracle.reach(at, value, k)));
        }
        let worst = parts.iter().map(|p| p.0).fold(0.0, f64::max);
        (worst, parts.iter().map(|p| p.1).sum::<f64>().sqrt())
    }
}

/// Solves at q with the core and compares.
pub fn compare(mechanism: &Mechanism, oracle: &Oracle, at: &mut Position, q: &[f64]) -> Worst {
    oracle.differentiate(at);
    let motion = mechanism
        .solve(&Request {
            dimensions: mechanism.drawing(),
            coordinates: Coordinates::Shared(q),
            signs: mechanism.signs(),
            order: ORDER,
            outputs: &Outputs::all(mechanism),
        })
        .expect("a class II mechanism");
    let diagnosis = &mechanism
        .diagnose(mechanism.drawing(), q, mechanism.signs())
        .expect("a class II mechanism")[0];
    assert!(
        matches!(diagnosis.status, Status::Ok | Status::NearSingular),
        "the oracle is there: {diagnosis}"
    );
    assert_eq!(motion.status, [diagnosis.status as u8]);
    let comparison = Comparison { oracle, at, drivers: q.len(), arms: oracle.arms(at) };
    let mut first = 0.0_f64;
    let mut worst = Worst { condition: diagnosis.condition, ..Worst::default() };
    for order in 0..=ORDER {
        let (error, size) = comparison.order(&motion, order);
        if order == 1 {
            first = size;
        }
        let law = if order == 0 {
            CLOSURE_PER_CONDITION * diagnosis.condition
        } else {
            ANALOGUE_PER_CONDITION_SQUARED * diagnosis.condition.powi(2)
        };
        let allowed = if order == 0 {
            law * oracle.extent(at)
        } else {
            let products = (0..order).map(|_| law * first).product::<f64>();
            law * size + if order == 1 { 0.0 } else { products }
        };
        worst.ratio[order] = if error == 0.0 { 0.0 } else { error / allowed };
    }
    worst
}
