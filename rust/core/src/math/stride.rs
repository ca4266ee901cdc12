//! What a kernel's loop takes of a column at once: one register, or two side by side, whose
//! operations need not wait for each other.

use super::lanes::{Mask, Real};
use super::pair::{Pair, PairMask};
use super::vector::Vector;

/// One register `R` of a column, or several.
pub(crate) trait Stride<R: Real>: Real {
    /// How many.
    const REGISTERS: usize;
    /// Those from `first` on.
    fn load(column: &[R], first: usize) -> Self;
    /// The same of vectors.
    fn load_vectors(column: &[Vector<R>], first: usize) -> Vector<Self>;
    /// The same of masks.
    fn load_masks(masks: &[R::Mask], first: usize) -> Self::Mask;
    /// Stores them from `first` on.
    fn store(self, column: &mut [R], first: usize);
    /// The same for vectors.
    fn store_vectors(vectors: Vector<Self>, column: &mut [Vector<R>], first: usize);
    /// The first of them.
    fn first(self) -> R;
    /// The same of a mask.
    fn first_mask(mask: Self::Mask) -> R::Mask;
    /// Adds lanes to masks.
    fn add_to(mask: Self::Mask, masks: &mut [R::Mask], first: usize);
}

impl<R: Real> Stride<R> for R {
    const REGISTERS: usize = 1;
    #[inline(always)]
    fn load(column: &[R], first: usize) -> Self {
        column[first]
    }
    #[inline(always)]
    fn load_vectors(column: &[Vector<R>], first: usize) -> Vector<Self> {
        column[first]
    }
    #[inline(always)]
    fn load_masks(masks: &[R::Mask], first: usize) -> Self::Mask {
        masks[first]
    }
    #[inline(always)]
    fn store(self, column: &mut [R], first: usize) {
        column[first] = self;
    }
    #[inline(always)]
    fn store_vectors(vectors: Vector<Self>, column: &mut [Vector<R>], first: usize) {
        column[first] = vectors;
    }
    #[inline(always)]
    fn first(self) -> R {
        self
    }
    #[inline(always)]
    fn first_mask(mask: Self::Mask) -> R::Mask {
        mask
    }
    #[inline(always)]
    fn add_to(mask: Self::Mask, masks: &mut [R::Mask], first: usize) {
        masks[first] = masks[first].or(mask);
    }
}

impl<R: Real> Stride<R> for Pair<R> {
    const REGISTERS: usize = 2;
    #[inline(always)]
    fn load(column: &[R], first: usize) -> Self {
        Self(column[first], column[first + 1])
    }
    #[inline(always)]
    fn load_vectors(column: &[Vector<R>], first: usize) -> Vector<Self> {
        let [a, b] = [column[first], column[first + 1]];
        Vector::new(Self(a.x, b.x), Self(a.y, b.y))
    }
    #[inline(always)]
    fn load_masks(masks: &[R::Mask], first: usize) -> Self::Mask {
        PairMask(masks[first], masks[first + 1])
    }
    #[inline(always)]
    fn store(self, column: &mut [R], first: usize) {
        column[first] = self.0;
        column[first + 1] = self.1;
    }
    #[inline(always)]
    fn store_vectors(vectors: Vector<Self>, column: &mut [Vector<R>], first: usize) {
        column[first] = Vector::new(vectors.x.0, vectors.y.0);
        column[first + 1] = Vector::new(vectors.x.1, vectors.y.1);
    }
    #[inline(always)]
    fn first(self) -> R {
        self.0
    }
    #[inline(always)]
    fn first_mask(mask: Self::Mask) -> R::Mask {
        mask.0
    }
    #[inline(always)]
    fn add_to(mask: Self::Mask, masks: &mut [R::Mask], first: usize) {
        masks[first] = masks[first].or(mask.0);
        masks[first + 1] = masks[first + 1].or(mask.1);
    }
}
