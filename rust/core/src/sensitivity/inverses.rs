//! The inverse of every step's matrix: derivatives of the closures by their unknowns.

use nalgebra::DMatrix;

use super::registers::{entry, entry_mut, grow};
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::plan::dyad::Unknown;
use crate::plan::plan::{EdgeSlide, Plan};
use crate::state::closures::{ClosedPath, Closures};

/// Work space; each entry has a register for so many lanes of positions.
#[derive(Debug, Default)]
pub(super) struct Inverses<R> {
    registers: usize,
    /// Columns of a matrix: two rows of an entry side by side.
    matrix: Vec<Vector<R>>,
    /// Inverses of the matrices, row by row.
    numbers: Vec<R>,
}

/// The edges and the guides along them, jet by jet, of which the matrices consist.
pub(super) struct Jets<'j, R> {
    pub edges: &'j [Vector<R>],
    pub guides: &'j [Vector<R>],
    /// Entries of a jet.
    pub len: usize,
}

impl<R: Real> Inverses<R> {
    /// Makes room for the numbers of all inverses.
    #[inline(always)]
    pub(super) fn begin(&mut self, numbers: usize, registers: usize) {
        self.registers = registers;
        grow(&mut self.numbers, numbers * registers);
    }

    /// An entry of the inverse that begins at `first`.
    #[inline(always)]
    pub(super) fn entry(&self, first: usize, place: usize) -> &[R] {
        entry(&self.numbers, first + place, self.registers)
    }

    /// Inverts the matrix of a step in every lane; the inverse of a singular one is not finite.
    #[inline(always)]
    pub(super) fn invert(
        &mut self,
        plan: &Plan,
        closures: &Closures,
        first: usize,
        jets: &Jets<'_, R>,
    ) {
        let registers = self.registers;
        let n = closures.unknowns.len();
        if let ([one, other], [path]) = (&closures.unknowns[..], &closures.paths[..]) {
            let inverse = &mut self.numbers[first * registers..][..n * n * registers];
            let columns = [*one, *other].map(|unknown| only_edge(plan, path, unknown));
            if let [Some(left), Some(right)] = columns {
                let jets = [left, right].map(|moved| jets.of(moved, registers));
                invert_two(inverse, jets, [left, right]);
                return;
            }
        }
        self.fill_matrix(plan, closures, jets);
        if n == 2 {
            let (left, right) = self.matrix[..n * registers].split_at(registers);
            let inverse = &mut self.numbers[first * registers..][..n * n * registers];
            invert_two(inverse, [left, right], [Moved::AS_IS; 2]);
        } else {
            self.invert_matrix(n, first);
        }
    }

    #[inline(always)]
    fn fill_matrix(&mut self, plan: &Plan, closures: &Closures, jets: &Jets<'_, R>) {
        let (n, registers) = (closures.unknowns.len(), self.registers);
        grow(&mut self.matrix, closures.paths.len() * n * registers);
        for (i, path) in closures.paths.iter().enumerate() {
            for (column, &unknown) in closures.unknowns.iter().enumerate() {
                let sums = entry_mut(&mut self.matrix, i * n + column, registers);
                sums.fill(Vector::ZERO);
                for &term in &path.edges {
                    let Some(moved) = Moved::by(plan, term, unknown) else { continue };
                    for (sum, &jet) in sums.iter_mut().zip(jets.of(moved, registers)) {
                        *sum += moved.column(jet);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn invert_matrix(&mut self, n: usize, first: usize) {
        for g in 0..self.registers {
            let lanes: Vec<Option<DMatrix<f64>>> =
                (0..R::LANES).map(|lane| self.lane_inverse(n, g, lane)).collect();
            for index in 0..n * n {
                let place = (index / n, index % n);
                let number = |lane: usize| lanes[lane].as_ref().map_or(f64::NAN, |m| m[place]);
                self.numbers[(first + index) * self.registers + g] = R::from_lanes(number);
            }
        }
    }

    /// The inverse in one lane, by LU with partial pivoting.
    #[inline(never)]
    fn lane_inverse(&self, n: usize, g: usize, lane: usize) -> Option<DMatrix<f64>> {
        let matrix = DMatrix::from_fn(n, n, |row, column| {
            let vector = self.matrix[(row / 2 * n + column) * self.registers + g];
            if row % 2 == 0 { vector.x } else { vector.y }.lane(lane)
        });
        matrix.lu().try_inverse()
    }
}

/// The inverse of two columns, each as its edge is moved.
#[inline(always)]
fn invert_two<R: Real>(
    inverse: &mut [R],
    [left, right]: [&[Vector<R>]; 2],
    [by_left, by_right]: [Moved; 2],
) {
    let registers = left.len();
    let (top, bottom) = inverse.split_at_mut(2 * registers);
    let (p, q) = top.split_at_mut(registers);
    let (r, s) = bottom.split_at_mut(registers);
    for g in 0..registers {
        let Vector { x: a, y: c } = by_left.column(left[g]);
        let Vector { x: b, y: d } = by_right.column(right[g]);
        let factor = R::ONE / (a * d - b * c);
        (p[g], q[g], r[g], s[g]) = (d * factor, -b * factor, -c * factor, a * factor);
    }
}

/// An edge with its sign in a closed path, and whether an unknown turns it; else it moves it along its guide.
#[derive(Debug, Clone, Copy)]
struct Moved {
    edge: usize,
    sign: f64,
    turns: bool,
}

impl Moved {
    /// A column that is whole.
    const AS_IS: Self = Self { edge: 0, sign: 1.0, turns: false };

    /// How an unknown moves an edge of a closed path, if it does.
    #[inline(always)]
    fn by(plan: &Plan, (edge, sign): (usize, f64), unknown: Unknown) -> Option<Self> {
        let turns = match (unknown, plan.edges[edge].along) {
            (Unknown::Class(class), _) if class == plan.edges[edge].class => true,
            (Unknown::Slide(slide), EdgeSlide::Slide(along)) if slide == along => false,
            _ => return None,
        };
        Some(Self { edge, sign, turns })
    }

    /// The derivative of the closed path, from the edge or its guide.
    #[inline(always)]
    fn column<R: Real>(self, jet: Vector<R>) -> Vector<R> {
        if self.turns { jet.left() } else { jet }.scale(R::splat(self.sign))
    }
}

impl<'j, R: Real> Jets<'j, R> {
    #[inline(always)]
    fn of(&self, moved: Moved, registers: usize) -> &'j [Vector<R>] {
        let jets = if moved.turns { self.edges } else { self.guides };
        entry(jets, moved.edge * self.len, registers)
    }
}

/// The only edge of a closed path that an unknown moves.
#[inline(always)]
fn only_edge(plan: &Plan, path: &ClosedPath, unknown: Unknown) -> Option<Moved> {
    let mut found = None;
    for &term in &path.edges {
        if let Some(moved) = Moved::by(plan, term, unknown) {
            if found.is_some() {
                return None;
            }
            found = Some(moved);
        }
    }
    found
}
