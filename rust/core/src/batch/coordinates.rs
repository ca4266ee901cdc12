//! Driver coordinates in registers, block by block: what all designs at the same positions share.

use crate::math::angle::MAX_TURNED;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::state::state::State;

/// The coordinates of a job's positions, of one driver.
pub(super) struct Coordinates<R, const G: usize> {
    blocks: Vec<Block<R, G>>,
    /// Registers with coordinates.
    pub(super) registers: usize,
    /// Index of the first of them among those that all designs share, if they are shared.
    shared: Option<usize>,
    /// Whether one of them is too far for angles that turn with the driver.
    pub(super) is_far: bool,
}

/// Coordinates with their unit vectors, as [`State`] has them.
struct Block<R, const G: usize> {
    q: Vec<[R; G]>,
    unit: Vec<[Vector<R>; G]>,
}

impl<R: Real, const G: usize> Block<R, G> {
    fn new() -> Self {
        Self { q: vec![[R::ZERO; G]], unit: vec![[Vector::ONE; G]] }
    }
}

impl<R: Real, const G: usize> Coordinates<R, G> {
    pub(super) fn new() -> Self {
        Self { blocks: Vec::new(), registers: 0, shared: None, is_far: false }
    }

    /// Loads coordinates; true if they are not the shared ones that were loaded last. `scale`: of
    /// a slide.
    #[inline(always)]
    pub(super) fn load(
        &mut self,
        q: &[f64],
        shared: Option<usize>,
        is_angle: bool,
        scale: f64,
    ) -> bool {
        if is_angle && shared.is_some() && self.shared == shared {
            return false;
        }
        self.shared = shared;
        self.is_far = q.iter().any(|q| q.abs() > MAX_TURNED);
        self.registers = q.len().div_ceil(R::LANES);
        self.blocks.resize_with(q.len().div_ceil(G * R::LANES), Block::new);
        for (block, some) in self.blocks.iter_mut().zip(q.chunks(G * R::LANES)) {
            // Lanes beyond the last position are solved with it.
            let at = |lane: usize| some[lane.min(some.len() - 1)] * scale;
            for (g, (q, unit)) in block.q[0].iter_mut().zip(&mut block.unit[0]).enumerate() {
                *q = R::from_lanes(|lane| at(g * R::LANES + lane));
                if is_angle && g * R::LANES < some.len() {
                    *unit = Vector::at_angle(*q);
                }
            }
        }
        true
    }

    /// Exchanges a block with the coordinates of a state.
    #[inline(always)]
    pub(super) fn swap(&mut self, block: usize, state: &mut State<R, G>) {
        let block = &mut self.blocks[block];
        std::mem::swap(&mut block.q, &mut state.q);
        std::mem::swap(&mut block.unit, &mut state.unit);
    }

    /// A register of coordinates.
    #[inline(always)]
    pub(super) fn q(&self, register: usize) -> R {
        self.blocks[register / G].q[0][register % G]
    }

    /// Their unit vectors.
    #[inline(always)]
    pub(super) fn unit(&self, register: usize) -> Vector<R> {
        self.blocks[register / G].unit[0][register % G]
    }
}
