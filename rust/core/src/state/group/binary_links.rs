//! Equations of groups of rigid links and turning pairs (see [`crate::plan::binary_links`]), for one
//! driver and one register of positions at a time.
//!
//! They are those of [`super::equations`]. The number of unknowns `N` is known to the compiler, so all
//! that one register needs stays in registers.

use super::newton::{Equations, iterate};
use super::turn::turned;
use crate::math::derivatives::ONE_DRIVER;
use crate::math::inverse::invert;
use crate::math::lanes::{Mask, Real};
use crate::math::tolerance::NEWTON_MAX_STEP;
use crate::math::vector::Vector;
use crate::plan::binary_links::{Links, MAX_UNKNOWNS};
use crate::plan::group::{BinaryLoops, Group, Loop};
use crate::state::state::{Context, State};
use crate::state::status::{Fault, Status};

/// Entries of a jet: the value and three analogues.
const ENTRIES: usize = ONE_DRIVER.len();
/// Entries of the greatest Jacobian and its inverse.
const MATRIX: usize = 2 * MAX_UNKNOWNS * MAX_UNKNOWNS;

impl<R: Real, const G: usize> State<R, G> {
    /// Solves a group of `N` loops (step `index`).
    #[inline(always)]
    pub(crate) fn solve_binary_loops<const N: usize>(
        &mut self,
        cx: &Context<'_>,
        group: &Group,
        binary: &BinaryLoops,
        index: usize,
    ) {
        let len = self.len.min(ENTRIES);
        let (Some(links), Some(classes), Some(bar_classes), Some(loops)) = (
            binary.links::<N>(&cx.constants.spans),
            binary.classes.first_chunk::<N>(),
            binary.bar_classes.first_chunk::<N>(),
            group.loops.first_chunk::<N>(),
        ) else {
            return;
        };
        // Loops: a closure of `map` would not be compiled with the level's instructions.
        let (mut inv_norms, mut max_arm2) = ([R::ZERO; N], [R::ZERO; N]);
        for i in 0..N {
            inv_norms[i] = R::splat(links.bars[i].inv_norm());
            max_arm2[i] = R::splat(cx.constants.max_arm2[classes[i]]);
        }
        let curvature = R::splat(cx.constants.curvature[group.index]);
        let mut bars_needed = [false; N];
        for i in 0..N {
            bars_needed[i] =
                self.work.angle_wanted[bar_classes[i]] || !loops[i].orientations.is_empty();
        }
        // Once: clearing them takes as long as a step.
        let (mut matrix, mut jets) = ([[R::ZERO]; MATRIX], Jets::NONE);
        for g in 0..self.groups.min(G) {
            let mut known = [Vector::ZERO; N];
            for (known, l) in known.iter_mut().zip(loops) {
                *known = self.pose.points[l.end * len][g] - self.pose.points[l.start * len][g];
            }
            let mut equations = BinaryEquations {
                links: &links,
                inv_norms,
                max_arm2,
                known,
                units: classes.map(|class| self.pose.class[class][g]),
                spans: [[Vector::ZERO; N]; N],
                chords: [Vector::ZERO; N],
                matrix: &mut matrix,
                curvature,
            };
            let skipped = [self.conditions.needs_scalar[g]];
            let last_determinant = [self.work.det_sign[group.index][g]];
            let newton = iterate(&mut equations, skipped, last_determinant);
            self.record_iteration(g, &newton, 0, group);
            for (&class, &unit) in classes.iter().zip(&equations.units) {
                self.pose.class[class][g] = unit;
            }
            for i in 0..N {
                if bars_needed[i] {
                    let bar = links.bars[i].on_lanes();
                    self.pose.class[bar_classes[i]][g] = bar.turn_to(equations.chords[i]);
                }
            }
            for arm in &binary.arms {
                let unit = self.pose.class[arm.class][g];
                let vector = Vector::splat(cx.constants.edge_vector[arm.edge]);
                self.pose.legs[arm.leg * len][g] = unit * vector;
            }
            if len > 1 {
                let [determinant] = equations.invert();
                self.work.determinants[group.index][g] = determinant;
                jets.start(&equations);
                let group_data = Analogues { binary, loops, classes, bar_classes, bars_needed };
                self.binary_analogues::<1, N>(g, &group_data, &equations, &mut jets);
                if len > 2 {
                    self.binary_analogues::<2, N>(g, &group_data, &equations, &mut jets);
                }
                if len > 3 {
                    self.binary_analogues::<3, N>(g, &group_data, &equations, &mut jets);
                }
            }
            if R::LANES == 1 && !newton.done[0].all() {
                self.fault = Some(Fault::NotConverged { step: index });
                self.status = Status::NotConverged;
                return;
            }
            self.update_condition(g, cx, group, index, newton.inverse_size2[0]);
        }
        let of_unknowns = group.orientations.iter().zip(classes);
        let of_bars = loops.iter().map(|l| &l.orientations).zip(bar_classes);
        for (orientations, &class) in of_unknowns.chain(of_bars) {
            for &o in orientations {
                for g in 0..self.groups.min(G) {
                    self.update_orientation(g, cx, o, class);
                }
            }
        }
    }

    /// Analogues of order `K` of the unknowns, of the needed bars and of the arms.
    #[inline(always)]
    fn binary_analogues<const K: usize, const N: usize>(
        &mut self,
        g: usize,
        group_data: &Analogues<'_, N>,
        equations: &BinaryEquations<'_, R, N>,
        jets: &mut Jets<R, N>,
    ) {
        let len = self.len;
        let mut known = [Vector::ZERO; N];
        for (known, l) in known.iter_mut().zip(group_data.loops) {
            let points = &self.pose.points;
            *known = points[l.end * len + K][g] - points[l.start * len + K][g];
        }
        jets.find::<K>(equations, &known, group_data.bars_needed);
        for i in 0..N {
            self.pose.theta[group_data.classes[i] * len + K][g] = jets.rates[i][K];
            if group_data.bars_needed[i] {
                self.pose.theta[group_data.bar_classes[i] * len + K][g] = jets.bar_rates[i][K];
            }
        }
        for arm in &group_data.binary.arms {
            let rate = |k: usize| &self.pose.theta[arm.class * len + k];
            let jet = &self.pose.legs[arm.leg * len..][..len];
            let mut sum = jet[0][g].scale(rate(K)[g]);
            for term in ONE_DRIVER[K] {
                sum += jet[term.left][g].scale(R::splat(term.factor) * rate(term.right)[g]);
            }
            self.pose.legs[arm.leg * len + K][g] = sum.left();
        }
    }
}

/// The parts of a group of `N` loops whose analogues are computed.
struct Analogues<'b, const N: usize> {
    binary: &'b BinaryLoops,
    loops: &'b [Loop; N],
    classes: &'b [usize; N],
    bar_classes: &'b [usize; N],
    /// The bars whose rotations are needed.
    bars_needed: [bool; N],
}

/// One register of positions of a group of `N` loops and as many unknown rotations.
struct BinaryEquations<'l, R, const N: usize> {
    links: &'l Links<'l, N>,
    /// 1/length of every bar.
    inv_norms: [R; N],
    /// Square of the greatest arm that turns with each unknown.
    max_arm2: [R; N],
    /// The known part of every loop: from its start to its end point.
    known: [Vector<R>; N],
    /// Unknown rotations.
    units: [Vector<R>; N],
    /// The turned spans, by loop and unknown.
    spans: [[Vector<R>; N]; N],
    /// The loops' chords.
    chords: [Vector<R>; N],
    /// The Jacobian, with its inverse beside it.
    matrix: &'l mut [[R; 1]; MATRIX],
    curvature: R,
}

impl<R: Real, const N: usize> BinaryEquations<'_, R, N> {
    /// Product of an unknown's row of the inverse with a right-hand side.
    #[inline(always)]
    fn inverse_times(&self, unknown: usize, right: &[R; N]) -> R {
        let mut sum = R::ZERO;
        for l in 0..N {
            sum += self.matrix[unknown * 2 * N + N + l][0] * right[l];
        }
        sum
    }
}

impl<R: Real, const N: usize> Equations<R, 1> for BinaryEquations<'_, R, N> {
    #[inline(always)]
    fn update(&mut self) {
        for l in 0..N {
            let mut chord = self.known[l];
            for unknown in 0..N {
                let span = Vector::splat(self.links.spans[l][unknown]);
                let turned = self.units[unknown] * span;
                self.spans[l][unknown] = turned;
                chord += turned;
            }
            self.chords[l] = chord;
        }
    }

    /// The equations are those of the bars' lengths.
    #[inline(always)]
    fn invert(&mut self) -> [R; 1] {
        for l in 0..N {
            let along = self.chords[l].scale(self.inv_norms[l]);
            for unknown in 0..N {
                // Derivative of the length: unit vector along the chord · i · span.
                self.matrix[l * 2 * N + unknown][0] = self.spans[l][unknown].cross(along);
            }
        }
        invert(self.matrix, N)
    }

    #[inline(always)]
    fn inverse_size2(&self) -> [R; 1] {
        let mut size2 = R::ZERO;
        for unknown in 0..N {
            let mut sum = R::ZERO;
            for l in 0..N {
                let entry = self.matrix[unknown * 2 * N + N + l][0];
                sum += entry * entry;
            }
            size2 += self.max_arm2[unknown] * sum;
        }
        [size2]
    }

    #[inline(always)]
    fn curvature(&self) -> R {
        self.curvature
    }

    #[inline(always)]
    fn step(&mut self, done: &[R::Mask; 1]) -> [R; 1] {
        let mut residual = [R::ZERO; N];
        for l in 0..N {
            let excess2 = self.chords[l].norm2() - R::splat(self.links.bars[l].norm2);
            residual[l] = excess2 * (R::splat(0.5) * self.inv_norms[l]);
        }
        let longest = R::splat(NEWTON_MAX_STEP);
        let mut largest = R::ZERO;
        for unknown in 0..N {
            let change = -self.inverse_times(unknown, &residual);
            let size = change.abs();
            // NaN must count as large, so that it does not look converged.
            largest = R::select(size.le(largest), largest, size);
            let old = self.units[unknown];
            let new = turned(old, change.max(-longest).min(longest));
            self.units[unknown] =
                Vector::new(R::select(done[0], old.x, new.x), R::select(done[0], old.y, new.y));
        }
        [largest]
    }
}

/// Jets of the loops, from the solved equations.
struct Jets<R, const N: usize> {
    /// Jets of the turned spans, by loop and unknown.
    spans: [[VectorJet<R>; N]; N],
    /// Jets of the loops' chords.
    chords: [VectorJet<R>; N],
    /// Analogues of the unknowns.
    rates: [[R; ENTRIES]; N],
    /// Analogues of the bars' rotations.
    bar_rates: [[R; ENTRIES]; N],
}

/// Jet of a vector.
type VectorJet<R> = [Vector<R>; ENTRIES];

impl<R: Real, const N: usize> Jets<R, N> {
    const NONE: Self = Self {
        spans: [[[Vector::ZERO; ENTRIES]; N]; N],
        chords: [[Vector::ZERO; ENTRIES]; N],
        rates: [[R::ZERO; ENTRIES]; N],
        bar_rates: [[R::ZERO; ENTRIES]; N],
    };

    /// Sets the values, from which the analogues follow order by order.
    #[inline(always)]
    fn start(&mut self, equations: &BinaryEquations<'_, R, N>) {
        for l in 0..N {
            self.chords[l][0] = equations.chords[l];
            for unknown in 0..N {
                self.spans[l][unknown][0] = equations.spans[l][unknown];
            }
        }
    }

    /// Analogues of order `K` of the unknowns and of the needed bars. Every order has the same matrix;
    /// the right-hand side follows from lower orders.
    #[inline(always)]
    fn find<const K: usize>(
        &mut self,
        equations: &BinaryEquations<'_, R, N>,
        known: &[Vector<R>; N],
        bars_needed: [bool; N],
    ) {
        let mut right = [R::ZERO; N];
        for l in 0..N {
            let mut chord = known[l];
            if K > 1 {
                for unknown in 0..N {
                    let span = without_top::<R, K>(&self.spans[l][unknown], &self.rates[unknown]);
                    self.spans[l][unknown][K] = span;
                    chord += span;
                }
            }
            self.chords[l][K] = chord;
            // Half the derivative of the square of the length.
            let jet = &self.chords[l];
            let mut sum = jet[0].dot(chord);
            match K {
                2 => sum += jet[1].norm2(),
                3 => sum += R::splat(3.0) * jet[1].dot(jet[2]),
                _ => {}
            }
            right[l] = sum * equations.inv_norms[l];
        }
        for unknown in 0..N {
            self.rates[unknown][K] = -equations.inverse_times(unknown, &right);
        }
        for l in 0..N {
            let mut chord = self.chords[l][K];
            for unknown in 0..N {
                let jet = &mut self.spans[l][unknown];
                let top = jet[0].left().scale(self.rates[unknown][K]);
                chord += top;
                if K == 1 {
                    jet[1] = top;
                } else {
                    jet[K] += top;
                }
            }
            self.chords[l][K] = chord;
            if !bars_needed[l] {
                continue;
            }
            // The chord is rigid: its jet follows from its lower entries.
            let mut top = chord;
            if K > 1 {
                top = top - without_top::<R, K>(&self.chords[l], &self.bar_rates[l]);
            }
            let inv_norm2 = R::splat(equations.links.bars[l].inv_norm2);
            self.bar_rates[l][K] = self.chords[l][0].cross(top) * inv_norm2;
        }
    }
}

/// Entry `K` of the jet of a vector that turns with these analogues, without the term in analogue
/// `K` itself.
#[inline(always)]
fn without_top<R: Real, const K: usize>(jet: &VectorJet<R>, rates: &[R; ENTRIES]) -> Vector<R> {
    let mut sum = Vector::ZERO;
    for term in ONE_DRIVER[K] {
        sum += jet[term.left].scale(R::splat(term.factor) * rates[term.right]);
    }
    sum.left()
}
