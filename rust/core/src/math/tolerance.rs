//! The thresholds that decide what is returned, each with its reason. Thresholds of a single search
//! stand beside that search.
//!
//! All except the limits of lengths are pure numbers: they are compared with lengths divided by the
//! size of the mechanism, or with sines of angles.

/// Unit roundoff u of binary64 as used in the error bounds (the spacing at 1).
pub const UNIT_ROUNDOFF: f64 = f64::EPSILON;

/// Greatest length or coordinate accepted: beyond it, squares and the third analogues of slides
/// would overflow.
pub const GREATEST_LENGTH: f64 = 1.0e153;

/// Least length accepted, for the same reason.
pub const LEAST_LENGTH: f64 = 1.0e-153;

/// Two joints coincide when their distance is below this fraction of their coordinates: it is then
/// only the rounding of the coordinates.
pub const ZERO_LENGTH: f64 = 4.0 * UNIT_ROUNDOFF;

/// Two guides of a drawing are parallel when their sine is below this (angles carry a few u).
pub const PARALLEL: f64 = 1.0e-12;

/// A dyad drawn with a smaller |sine| between its legs does not show its assembly.
///
/// Lengths computed from coordinates are accurate to a few u. Near the flat dyad the sine between
/// the legs is the square root of such a difference, so rounding hides anything below a few √u =
/// 1.5e-8.
pub const FLAT_SINE: f64 = 6.0e-8;

/// Closure error, relative to the longer side, up to which a triangle of lengths counts as exactly
/// flat: the closing side is a sum of a few rounded terms, each accurate to u.
pub const FLAT_CLOSURE: f64 = 16.0 * UNIT_ROUNDOFF;

/// Singular values below this fraction of the largest count as zero in a rank. Columns are scaled
/// to unit length first; coordinates carry u, and a factor of 1e7 covers drawings typed with nine
/// digits.
pub const RANK: f64 = 2.0e-9;

/// Residual, relative to the size, to which a displaced mechanism must close before its rank is
/// trusted. Gauss-Newton converges quadratically, so the residual is either below this or far
/// above.
pub const REGULAR_CLOSURE: f64 = 1.0e-12;

/// Elimination pivots below this are not solved for when a displaced linkage is returned to its
/// closure.
pub const TRUNCATED: f64 = 1.0e-6;

/// Elimination pivots below this belong to equations that nearly depend on others: links that would
/// be redundant but are drawn with few digits. (The condition amplifies their misfit.)
pub const NEARLY_DEPENDENT: f64 = 1.0e-2;

/// Greatest misfit, relative to the size, at which such links are reported to nearly fit.
pub const NEARLY_REDUNDANT: f64 = 1.0e-4;

/// A redundant link fits while its misfit is below this fraction of the size (or below
/// [`CLOSURE_PER_CONDITION`] times the condition). To make redundant links fit, joints of a drawing
/// are moved by no more than this. Drawings typed with nine digits are off by less.
pub const REDUNDANT_CLOSURE: f64 = 2.0e-9;

/// Misfit of redundant links that counts as rounding of the drawing, even for a drawing far from
/// its origin or with ten or twenty links.
pub const REDUNDANT_ROUNDING: f64 = 1024.0 * UNIT_ROUNDOFF;

/// Greatest misfit at which a redundant link can fit, however bad the condition.
pub const REDUNDANT_MAX: f64 = 1.0e-6;

/// Error of a position per unit of condition, relative to the size: 2 u measured on the dyad RRR,
/// 8 u with a margin (the design's bound).
pub const CLOSURE_PER_CONDITION: f64 = 8.0 * UNIT_ROUNDOFF;

/// Error of an analogue per unit of squared condition, relative to the analogue.
pub const ANALOGUE_PER_CONDITION_SQUARED: f64 = 64.0 * UNIT_ROUNDOFF;

/// Condition from which a position is near-singular: 64 u κ², the relative error of its analogues
/// ([`ANALOGUE_PER_CONDITION_SQUARED`]), reaches 1e-6.
pub const NEAR_SINGULAR_CONDITION: f64 = 8388.608;

/// Condition from which a dyad cannot be distinguished from a flat one. 1/κ is the square root of a
/// difference of rounded lengths, so beyond 1/(4 √u) = 2^24 it holds no correct digit. (The
/// condition upstream of the dyad may be greater, but it rarely acts across the flat dyad: chains
/// of parallelograms pass their change points without loss.)
pub const SINGULAR_CONDITION: f64 = 16_777_216.0;

/// Step, as a fraction of a cell of the branch, between the six points that decide on a change
/// point: large enough for a well-conditioned discriminant, small enough for a polynomial of degree six
/// (error of the order of its sixth power).
pub const CHANGE_STEP: f64 = 1.0 / 128.0;

/// Squared discriminant, per unit of the upstream condition, below which the discriminant counts as
/// zero: six values, each accurate to a few u, with weights up to 15/10.
pub const CHANGE_DISCRIMINANT: f64 = 64.0 * UNIT_ROUNDOFF;

/// Limit of the upstream condition counted there: the product of the conditions overestimates
/// chains that are singular together.
pub const CHANGE_CONDITION: f64 = 1.0e3;

/// Distance (rad, or units of the scale) from a change point within which the smooth motion through
/// it is used: closer, fewer than six digits of the analogues would remain.
pub const CHANGE_REACH: f64 = 1.0 / NEAR_SINGULAR_CONDITION;

/// Distance within which a position is the change point itself: closer, no dyad can be
/// distinguished from a flat one.
pub const CHANGE_WIDTH: f64 = 1.0 / SINGULAR_CONDITION;

/// Closure, relative to the size, required of the polynomial through a change point. Some 20
/// states, each closed to a few u, have no more rounding than this; the rest is truncation.
pub const SMOOTH_CLOSURE: f64 = 256.0 * UNIT_ROUNDOFF;

/// Distance, relative to the size and per unit of condition, allowed between that smooth motion and
/// the solved position: the errors of both. A greater one shows another event near by.
pub const CHANGE_MISFIT: f64 = 4.0 * CLOSURE_PER_CONDITION;

/// Product of the two steps (rad, or units of the scale) of a Newton round below which a group
/// above class II has converged: about this much of the error remains.
pub const NEWTON_TOLERANCE: f64 = UNIT_ROUNDOFF;
/// Limit of (first step × condition)² of a round for its Jacobian to be close to the one at the
/// solution, so that the second step may reuse it. Beyond a condition of 2^25 no step is that
/// short, and the Jacobian is not known well enough.
pub const NEWTON_FROZEN_MAX2: f64 = 1.0 / 16.0;
/// Step below which the iteration has converged in any case: the next would be about its square.
pub const NEWTON_LAST_STEP: f64 = 1.0 / 67_108_864.0;
/// Limit of Newton rounds: from within the tracer's own steps one or two are enough.
pub const NEWTON_MAX_ROUNDS: usize = 8;
/// Longest Newton step: a link that turns by more only shows that the first guess is far away.
pub const NEWTON_MAX_STEP: f64 = 0.5;

/// Largest turn of a link between neighbouring knots of the branch whose angles are unwrapped; half
/// a turn would already be ambiguous.
pub const KNOT_MAX_TURN: f64 = std::f64::consts::FRAC_PI_4;

/// Limit of halvings of a cell of that branch: 2^-40 of a cell is below the spacing of q.
pub const KNOT_MAX_HALVINGS: u32 = 40;
