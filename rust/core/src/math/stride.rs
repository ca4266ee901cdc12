//! The registers of a column that a kernel's loop takes at once: one, or two whose operations need not
//! wait for each other.

use super::lanes::{Mask, Real};
use super::pair::{Pair, PairMask};
use super::vector::Vector;

/// One register `R`, or several consecutive ones.
pub(crate) trait Stride<R: Real>: Real {
    /// Number of registers.
    const REGISTERS: usize;
    /// Loads the registers of a column from index `first` on.
    fn load(column: &[R], first: usize) -> Self;
    /// Loads registers of a column of vectors from index `first` on.
    fn load_vectors(column: &[Vector<R>], first: usize) -> Vector<Self>;
    /// Loads the masks of registers from index `first` on.
    fn load_masks(masks: &[R::Mask], first: usize) -> Self::Mask;
    /// Stores the registers in a column from index `first` on.
    fn store(self, column: &mut [R], first: usize);
    /// Stores registers of vectors in a column from index `first` on.
    fn store_vectors(vectors: Vector<Self>, column: &mut [Vector<R>], first: usize);
    /// The first register.
    fn first(self) -> R;
    /// The mask of the first register.
    fn first_mask(mask: Self::Mask) -> R::Mask;
    /// Adds the lanes of `mask` to the masks of registers from index `first` on.
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
