//! Whether a dyad closes, and how far it is from flat.

use super::status::FLAT2;
use crate::math::lanes::{Mask, Real};
use crate::math::stride::Stride;

/// Whether a dyad closes, and how far it is from flat.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Closing<R: Real> {
    /// Lanes where it does not close. Without `CHECKED` some may be missing; their `sine2` is NaN or not
    /// positive.
    pub open: R::Mask,
    /// Lanes where it is flat: the two solutions coincide to rounding.
    pub flat: R::Mask,
    /// Square of the sine of the angle between the columns of the closure matrix: between the legs
    /// of two binary links.
    pub sine2: R,
    /// The margin with which it closes, relative to the scale; negative where it does not close (`CHECKED`).
    pub margin: R,
    /// The missing length where it does not close; infinite if no length suffices (`CHECKED`).
    pub gap: R,
    /// For each unknown, the factor of its squared arm in the condition; 0 for a slide.
    pub per_arm2: [R; 2],
}

impl<R: Real> Closing<R> {
    pub(crate) const CLOSED: Self = Self {
        open: R::Mask::NONE,
        flat: R::Mask::NONE,
        sine2: R::ONE,
        margin: R::ZERO,
        gap: R::ZERO,
        per_arm2: [R::ZERO; 2],
    };

    /// The part that belongs to the first register.
    #[inline(always)]
    pub(crate) fn first<F: Real>(&self) -> Closing<F>
    where
        R: Stride<F>,
    {
        Closing {
            open: R::first_mask(self.open),
            flat: R::first_mask(self.flat),
            sine2: self.sine2.first(),
            margin: self.margin.first(),
            gap: self.gap.first(),
            per_arm2: [self.per_arm2[0].first(), self.per_arm2[1].first()],
        }
    }

    /// How a slide closes whose value is a length, between joints at this squared distance. Where they
    /// coincide the length is 0, and only its direction is not determined: flat. `scale2`: the square of
    /// their coordinates.
    #[inline(always)]
    pub(crate) fn of_length(mut self, distance2: R, across: R, scale2: R) -> Self {
        let least2 = R::splat(FLAT2) * scale2;
        let loose = R::ZERO.lt(distance2.max(across.abs())).not();
        self.open = self.open.and(loose.not());
        let near = distance2.lt(least2).or(loose);
        self.flat = self.flat.or(near).and(self.open.not());
        self.sine2 = R::select(loose, R::ONE, self.sine2);
        self.per_arm2[0] = R::select(near, R::ONE / least2, self.per_arm2[0]);
        self.gap = R::select(loose, R::ZERO, self.gap);
        self
    }

    /// How two slides with these values close, along lines with this determinant.
    #[inline(always)]
    pub(crate) fn of_lines(s: R, t: R, determinant: R) -> Self {
        let open = s.finite().and(t.finite()).not();
        let sine2 = determinant * determinant;
        Self {
            open,
            flat: sine2.lt(R::splat(FLAT2)).and(open.not()),
            sine2,
            margin: R::ONE,
            gap: R::splat(f64::INFINITY),
            ..Self::CLOSED
        }
    }
}
