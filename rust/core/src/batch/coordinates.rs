//! Driver coordinates in registers, block by block. Designs at the same positions share them.

use crate::branch::design::Design;
use crate::math::angle::MAX_TURNED;
use crate::math::lanes::{Mask, Real};
use crate::math::vector::Vector;
use crate::plan::plan::Plan;
use crate::state::state::State;

/// Coordinates of points, with their derivatives, of which [`BLOCK`](crate::state::kernel::BLOCK)
/// positions fit in a first-level cache.
const MAX_NUMBERS: usize = 40;
/// Positions of a block for a request with more.
const LARGE_BLOCK: usize = 80;

/// The coordinates of a job's positions.
pub(super) struct CoordinateRegisters<R, const G: usize> {
    blocks: Vec<CoordinateBlock<R, G>>,
    /// Registers with coordinates.
    pub(super) registers: usize,
    /// Offset into the shared coordinates, if shared.
    shared: Option<usize>,
    /// The coordinates that are loaded, if they are angles of one driver: the next call may have the same.
    loaded: Vec<f64>,
    /// Whether each driver's coordinate is an angle.
    is_angle: Vec<bool>,
    /// Whether a coordinate is too large for [`Reference::Turning`](crate::math::angle::Reference).
    pub(super) is_far: bool,
    /// Whether all of them are finite.
    pub(super) are_finite: bool,
    /// Registers of a block, at most `G`.
    pub(super) block: usize,
}

/// Coordinates with their unit vectors, as [`State`] has them.
struct CoordinateBlock<R, const G: usize> {
    q: Vec<[R; G]>,
    unit: Vec<[Vector<R>; G]>,
    /// Whether its positions must be solved one by one.
    by_position: bool,
}

impl<R: Real, const G: usize> CoordinateBlock<R, G> {
    fn new(drivers: usize) -> Self {
        let (q, unit) = (vec![[R::ZERO; G]; drivers], vec![[Vector::ONE; G]; drivers]);
        Self { q, unit, by_position: false }
    }
}

impl<R: Real, const G: usize> CoordinateRegisters<R, G> {
    /// `len`: entries of a jet.
    pub(super) fn new(plan: &Plan, len: usize) -> Self {
        let drivers = 0..plan.drivers.len();
        let is_angle = drivers.map(|driver| plan.driven_slide(driver).is_none()).collect();
        let is_large = 2 * plan.points * len > MAX_NUMBERS;
        let block = if is_large { (LARGE_BLOCK / R::LANES).min(G) } else { G };
        Self {
            blocks: Vec::new(),
            registers: 0,
            shared: None,
            loaded: Vec::new(),
            is_angle,
            is_far: false,
            are_finite: false,
            block,
        }
    }

    /// Forgets which shared coordinates are loaded.
    pub(super) fn forget(&mut self) {
        self.shared = None;
    }

    /// Loads coordinates, drivers fastest, rad or m. Returns false if these shared coordinates were
    /// loaded already.
    #[inline(always)]
    pub(super) fn load(&mut self, q: &[f64], shared: Option<usize>, design: &Design<'_>) -> bool {
        // Slides are scaled by the design's unit of length, so they must be loaded again.
        let same = self.shared.is_some() && self.shared == shared;
        if same && self.is_angle.iter().all(|&angle| angle) {
            return false;
        }
        self.shared = shared;
        let bits = |q: &f64| q.to_bits();
        if self.is_angle[..] == [true] && self.loaded.iter().map(bits).eq(q.iter().map(bits)) {
            return true;
        }
        self.loaded.clear();
        if self.is_angle[..] == [true] {
            self.loaded.extend_from_slice(q);
        }
        (self.is_far, self.are_finite) = (false, true);
        // No search that stops at the first: this reads them by vectors.
        for q in q {
            self.is_far |= q.abs() > MAX_TURNED;
        }
        let drivers = self.is_angle.len();
        let positions = q.len() / drivers;
        self.registers = positions.div_ceil(R::LANES);
        let needed = positions.div_ceil(self.block * R::LANES);
        if self.blocks.len() < needed {
            self.blocks.resize_with(needed, || CoordinateBlock::new(drivers));
        }
        for (block, chunk) in self.blocks.iter_mut().zip(q.chunks(self.block * R::LANES * drivers))
        {
            let positions = chunk.len() / drivers;
            block.by_position = false;
            for (driver, &is_angle) in self.is_angle.iter().enumerate() {
                let scale = R::splat(design.units.coordinate[driver]);
                let columns = block.q[driver].iter_mut().zip(&mut block.unit[driver]);
                // A kernel may take two registers at once.
                let used = positions.div_ceil(R::LANES) + 1;
                for (g, (q, unit)) in columns.enumerate().take(used) {
                    *q = read::<R>(chunk, drivers, driver, g * R::LANES) * scale;
                    if g * R::LANES >= positions {
                        continue;
                    }
                    self.are_finite &= q.finite().all();
                    block.by_position |= drivers > 1 && design.cannot_follow(driver, *q);
                    if is_angle {
                        *unit = Vector::at_angle(*q);
                    }
                }
            }
        }
        true
    }

    /// Whether the positions of a block must be solved one by one.
    pub(super) fn by_position(&self, block: usize) -> bool {
        self.blocks[block].by_position
    }

    /// Swaps a block with the coordinates of a state.
    #[inline(always)]
    pub(super) fn swap(&mut self, block: usize, state: &mut State<R, G>) {
        let block = &mut self.blocks[block];
        std::mem::swap(&mut block.q, &mut state.pose.q);
        std::mem::swap(&mut block.unit, &mut state.pose.unit);
    }

    /// One register of a driver's coordinates.
    #[inline(always)]
    pub(super) fn q(&self, driver: usize, register: usize) -> R {
        self.blocks[register / self.block].q[driver][register % self.block]
    }

    /// The unit vectors at these coordinates.
    #[inline(always)]
    pub(super) fn unit(&self, driver: usize, register: usize) -> Vector<R> {
        self.blocks[register / self.block].unit[driver][register % self.block]
    }
}

/// The numbers of a driver at the positions from `first` on; lanes past the last position repeat it.
#[inline(always)]
fn read<R: Real>(chunk: &[f64], drivers: usize, driver: usize, first: usize) -> R {
    // Widths known to the compiler are read by few instructions.
    match (chunk.get(first * drivers..(first + R::LANES) * drivers), drivers) {
        (Some(all), 1) => R::read(all),
        (Some(all), 2) => R::read(all).unzip(R::read(&all[R::LANES..]))[driver],
        _ => {
            let last = chunk.len() / drivers - 1;
            R::from_lanes(|lane| chunk[(first + lane).min(last) * drivers + driver])
        }
    }
}
