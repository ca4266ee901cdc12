//! Numbers of assemblies, real and complex, of groups of class III to V.

use assur::{Assemblies, Assembly, ClassIv, Description, Mechanism};

fn described(joints: &[(&str, [f64; 2])], links: &[(&str, &[&str])]) -> Description {
    let mut description = Description::new();
    for &(name, at) in joints {
        description = description.joint(name, at);
    }
    for &(name, of) in links {
        description = description.link(name, of.iter().copied());
    }
    description.driver("crank")
}

/// Crank O-A, legs A-P, U-Q, V-R, plate PQR.
fn triad(points: [[f64; 2]; 7]) -> Mechanism {
    let names = ["O", "A", "P", "Q", "R", "U", "V"];
    let joints: Vec<_> = names.into_iter().zip(points).collect();
    let links: [(&str, &[&str]); 6] = [
        ("ground", &["O", "U", "V"]),
        ("crank", &["O", "A"]),
        ("plate", &["P", "Q", "R"]),
        ("l1", &["A", "P"]),
        ("l2", &["U", "Q"]),
        ("l3", &["V", "R"]),
    ];
    Mechanism::new(&described(&joints, &links)).unwrap()
}

/// Angle of a link in an assembly, less that in the drawing.
fn rotation(mechanism: &Mechanism, assembly: &Assembly, link: &str) -> f64 {
    let link = &mechanism.linkage().links[mechanism.link(link).unwrap()];
    let [a, b] = [link.joints[0], link.joints[1]];
    let angle = |at: [[f64; 2]; 2]| (at[1][1] - at[0][1]).atan2(at[1][0] - at[0][0]);
    let joints = &mechanism.linkage().joints;
    let turned =
        angle([assembly.joints[a], assembly.joints[b]]) - angle([joints[a].at, joints[b].at]);
    turned.sin().atan2(turned.cos())
}

/// The rotations of some links, sorted by the first.
fn rotations(mechanism: &Mechanism, all: &Assemblies, links: &[&str]) -> Vec<Vec<f64>> {
    let of = |assembly| links.iter().map(|link| rotation(mechanism, assembly, link)).collect();
    let mut rotations: Vec<Vec<f64>> = all.found.iter().map(of).collect();
    rotations.sort_by(|a, b| a[0].total_cmp(&b[0]));
    rotations
}

fn assert_rotations(found: &[Vec<f64>], expected: &mut [Vec<f64>]) {
    expected.sort_by(|a, b| a[0].total_cmp(&b[0]));
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        for (a, b) in found.iter().zip(expected.iter()) {
            assert!((a - b).abs() < 1e-10, "{found:?} {expected:?}");
        }
    }
}

#[test]
fn triad_with_six_real_assemblies() {
    let mechanism = triad([
        [0.45, 2.8],
        [-0.34, 3.2],
        [2.43, 0.41],
        [1.26, 2.45],
        [0.04, 1.89],
        [2.38, 1.54],
        [2.18, 0.68],
    ]);
    let all = mechanism.assemblies(mechanism.drawing(), mechanism.q0(), None).unwrap();
    assert_eq!((all.complex_counts.as_slice(), all.failures.len()), (&[6][..], 0));
    let expected = [
        0.0,
        2.397_803_852_46,
        2.491_493_864_47,
        -0.163_176_950_242,
        -1.247_994_445_67,
        -1.111_846_259_01,
    ];
    let mut expected: Vec<Vec<f64>> = expected.iter().map(|&x| vec![x]).collect();
    assert_rotations(&rotations(&mechanism, &all, &["plate"]), &mut expected);
}

/// The class IV mechanism of the paper.
#[test]
fn sixteen_complex_assemblies_and_two_real_ones() {
    let joints = [
        [0.0, 0.0],
        [0.35, 0.0],
        [1.24, 0.99],
        [0.75, 1.91],
        [3.02, -0.73],
        [2.45, 1.02],
        [3.2, 2.24],
        [1.85, 2.35],
        [1.62, -1.11],
        [4.28, 1.52],
    ];
    let mechanism = Mechanism::new(&ClassIv::description(joints)).unwrap();
    let links = ["l234", "l365", "l48", "l876", "l95", "l107"];
    let cases = [
        (
            0.0,
            [
                [0.0; 6],
                [
                    -42.007_709_177_4,
                    -22.891_653_793_1,
                    -23.190_790_696_6,
                    -36.532_564_665_5,
                    -60.250_730_485_5,
                    117.014_429_992,
                ],
            ],
        ),
        (
            100.0_f64,
            [
                [
                    -15.214_790_646_6,
                    3.860_194_636_40,
                    3.559_959_529_13,
                    -9.751_556_917_53,
                    8.387_408_162_60,
                    -0.700_192_950_234,
                ],
                [
                    -62.974_904_299_8,
                    -4.431_084_246_77,
                    1.031_252_294_23,
                    -43.492_148_161_9,
                    -45.888_550_430_4,
                    102.839_236_667,
                ],
            ],
        ),
    ];
    for (q, expected) in cases {
        let q = mechanism.q0()[0] + q.to_radians();
        let all = mechanism.assemblies(mechanism.drawing(), &[q], None).unwrap();
        assert_eq!((all.complex_counts.as_slice(), all.failures.len()), (&[16][..], 0));
        let mut expected: Vec<Vec<f64>> =
            expected.iter().map(|of| of.iter().map(|x: &f64| x.to_radians()).collect()).collect();
        assert_rotations(&rotations(&mechanism, &all, &links), &mut expected);
    }
}
