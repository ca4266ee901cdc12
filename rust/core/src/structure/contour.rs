//! Class of a group from its contours: a minimum cycle basis (Horton 1987).

use std::collections::{HashSet, VecDeque};
use std::sync::atomic::AtomicBool;

use crate::description::error::{Interrupted, check_flag};

/// Lengths of the cycles of a minimum cycle basis of an undirected graph.
///
/// Each vertex and edge give one candidate: the edge, closed by shortest paths from the
/// vertex. Taking independent candidates (over GF(2)), shortest first, gives a minimum basis.
///
/// # Errors
///
/// [`Interrupted`] once `cancel` is true.
pub(crate) fn minimum_cycle_basis(
    vertices: usize,
    edges: &[(usize, usize)],
    cancel: Option<&AtomicBool>,
) -> Result<Vec<usize>, Interrupted> {
    let mut candidates: Vec<HashSet<usize>> = Vec::new();
    for root in 0..vertices {
        check_flag(cancel)?;
        let paths = shortest_paths(vertices, edges, root);
        for (e, &(a, b)) in edges.iter().enumerate() {
            let (Some(to_a), Some(to_b)) = (&paths[a], &paths[b]) else { continue };
            let mut cycle: HashSet<usize> = to_a.symmetric_difference(to_b).copied().collect();
            if cycle.insert(e) && !cycle.is_empty() {
                candidates.push(cycle);
            }
        }
    }
    candidates.sort_by_key(HashSet::len);
    let mut basis: Vec<(usize, HashSet<usize>)> = Vec::new();
    let mut lengths = Vec::new();
    for candidate in candidates {
        check_flag(cancel)?;
        let length = candidate.len();
        let mut remainder = candidate;
        for (pivot, reduced) in &basis {
            if remainder.contains(pivot) {
                remainder = remainder.symmetric_difference(reduced).copied().collect();
            }
        }
        if let Some(&pivot) = remainder.iter().min() {
            basis.push((pivot, remainder));
            lengths.push(length);
        }
    }
    Ok(lengths)
}

/// Edges of a shortest path from `root` to each vertex that it reaches.
fn shortest_paths(
    vertices: usize,
    edges: &[(usize, usize)],
    root: usize,
) -> Vec<Option<HashSet<usize>>> {
    let mut paths: Vec<Option<HashSet<usize>>> = vec![None; vertices];
    paths[root] = Some(HashSet::new());
    let mut queue = VecDeque::from([root]);
    while let Some(current) = queue.pop_front() {
        for (e, &(a, b)) in edges.iter().enumerate() {
            let next = match current {
                v if v == a => b,
                v if v == b => a,
                _ => continue,
            };
            if paths[next].is_none() {
                let mut path = paths[current].clone().unwrap_or_default();
                path.insert(e);
                paths[next] = Some(path);
                queue.push_back(next);
            }
        }
    }
    paths
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangle_and_square_sharing_an_edge() {
        let edges = [(0, 1), (1, 2), (2, 0), (1, 3), (3, 4), (4, 2)];
        let lengths = minimum_cycle_basis(5, &edges, None).map(|mut lengths| {
            lengths.sort_unstable();
            lengths
        });
        assert_eq!(lengths, Ok(vec![3, 4]));
    }

    #[test]
    fn complete_graph_on_four_vertices_has_three_triangles() {
        let edges = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
        assert_eq!(minimum_cycle_basis(4, &edges, None), Ok(vec![3, 3, 3]));
    }

    #[test]
    fn a_tree_has_no_cycle() {
        assert_eq!(minimum_cycle_basis(3, &[(0, 1), (1, 2)], None), Ok(vec![]));
    }
}
