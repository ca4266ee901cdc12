//! The formulas of two mechanisms fused into one loop by hand, without checks or statuses: how fast
//! the core could be if it knew the mechanism. Value and two analogues of two outputs, as in the
//! sweeps beside it.

use assur::trig::unit_angle;

/// One column a derivative, of two outputs.
pub type Rows<'r> = [&'r mut [f64]; 6];

/// What both mechanisms are given: cosines and sines of the driver.
pub type Turn<'t> = (&'t [f64], &'t [f64]);

/// Angles of coupler and rocker of a four-bar with these lengths (crank, coupler, rocker, ground).
#[inline(always)]
fn four_bar_loop([crank, a, b, ground]: [f64; 4], (cos, sin): Turn<'_>, rows: &mut Rows<'_>) {
    let [u0, u1, u2, v0, v1, v2] = rows;
    let n = cos.len();
    let (sin, u0, u1, u2) = (&sin[..n], &mut u0[..n], &mut u1[..n], &mut u2[..n]);
    let (v0, v1, v2) = (&mut v0[..n], &mut v1[..n], &mut v2[..n]);
    let (sum2, difference2, split) = ((a + b) * (a + b), (a - b) * (a - b), (a - b) * (a + b));
    let (per_a, per_b) = (1.0 / a, 1.0 / b);
    for i in 0..n {
        let (bx, by) = (crank * cos[i], crank * sin[i]);
        let (kx, ky) = (ground - bx, -by);
        let d2 = kx * kx + ky * ky;
        let area2 = (sum2 - d2) * (d2 - difference2);
        let area = area2.sqrt();
        let inverse = 0.5 / (d2 * area);
        let (along, across) = ((d2 + split) * (area * inverse), area2 * inverse);
        let (ax, ay) = (kx * along - ky * across, kx * across + ky * along);
        let (cx, cy) = (kx - ax, ky - ay);
        let per = -4.0 * (d2 * inverse);
        // The chord's first derivative is (by, −bx), its second b.
        let u = (cx * by - cy * bx) * per;
        let v = -((ax * by - ay * bx) * per);
        let (uu, vv) = (u * u, v * v);
        let (rx, ry) = (bx + ax * uu + cx * vv, by + ay * uu + cy * vv);
        u1[i] = u;
        v1[i] = v;
        u2[i] = (cx * rx + cy * ry) * per;
        v2[i] = -((ax * rx + ay * ry) * per);
        u0[i] = unit_angle(ax * per_a, ay * per_a);
        // From the rocker's pivot to the coupler.
        v0[i] = unit_angle(-cx * per_b, -cy * per_b);
    }
}

/// Position of the piston and angle of the rod of a slider-crank (crank, rod, offset).
#[inline(always)]
fn slider_crank_loop([crank, rod, offset]: [f64; 3], (cos, sin): Turn<'_>, rows: &mut Rows<'_>) {
    let [s0, s1, s2, u0, u1, u2] = rows;
    let n = cos.len();
    let (sin, s0, s1, s2) = (&sin[..n], &mut s0[..n], &mut s1[..n], &mut s2[..n]);
    let (u0, u1, u2) = (&mut u0[..n], &mut u1[..n], &mut u2[..n]);
    let per_rod = 1.0 / rod;
    for i in 0..n {
        let (bx, by) = (crank * cos[i], crank * sin[i]);
        let y = offset - by;
        let x = ((rod - y) * (rod + y)).sqrt();
        let per = 1.0 / x;
        let u = -bx * per;
        let w = (by + y * (u * u)) * per;
        s0[i] = bx + x;
        s1[i] = -by - y * u;
        s2[i] = -bx - y * w - x * (u * u);
        u0[i] = unit_angle(x * per_rod, y * per_rod);
        u1[i] = u;
        u2[i] = w;
    }
}

macro_rules! with_features {
    ($name:ident, $features:literal) => {
        /// Both loops with these instructions.
        pub mod $name {
            use super::{Rows, Turn, four_bar_loop, slider_crank_loop};
            #[target_feature(enable = $features)]
            pub fn four_bar(lengths: [f64; 4], turn: Turn<'_>, rows: &mut Rows<'_>) {
                four_bar_loop(lengths, turn, rows);
            }
            #[target_feature(enable = $features)]
            pub fn slider_crank(lengths: [f64; 3], turn: Turn<'_>, rows: &mut Rows<'_>) {
                slider_crank_loop(lengths, turn, rows);
            }
        }
    };
}

with_features!(avx2, "avx2");
with_features!(avx512, "avx512f,avx512vl,avx512dq");
