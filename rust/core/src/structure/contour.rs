//! Class of a group from its contours: a minimum cycle basis (Horton 1987).

use std::collections::{HashSet, VecDeque};

/// Lengths of the cycles of a minimum cycle basis of an undirected graph.
///
/// Candidates are, for every vertex and every edge, the edge closed by shortest
/// paths from the vertex; a greedy choice of independent ones (over GF(2)) is a
/// minimum basis.
#[must_use]
pub(crate) fn minimum_cycle_basis(vertices: usize, edges: &[(usize, usize)]) -> Vec<usize> {
    let mut candidates: Vec<HashSet<usize>> = Vec::new();
    for root in 0..vertices {
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
        let length = candidate.len();
        let mut rest = candidate;
        for (pivot, reduced) in &basis {
            if rest.contains(pivot) {
                rest = rest.symmetric_difference(reduced).copied().collect();
            }
        }
        if let Some(&pivot) = rest.iter().min() {
            basis.push((pivot, rest));
            lengths.push(length);
        }
    }
    lengths
}

/// Edge sets of shortest paths from `root` to every vertex it reaches.
fn shortest_paths(
    vertices: usize,
    edges: &[(usize, usize)],
    root: usize,
) -> Vec<Option<HashSet<usize>>> {
    let mut paths: Vec<Option<HashSet<usize>>> = vec![None; vertices];
    paths[root] = Some(HashSet::new());
    let mut queue = VecDeque::from([root]);
    while let Some(here) = queue.pop_front() {
        for (e, &(a, b)) in edges.iter().enumerate() {
            let next = match here {
                h if h == a => b,
                h if h == b => a,
                _ => continue,
            };
            if paths[next].is_none() {
                let mut path = paths[here].clone().unwrap_or_default();
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
        let mut lengths = minimum_cycle_basis(5, &edges);
        lengths.sort_unstable();
        assert_eq!(lengths, [3, 4]);
    }

    #[test]
    fn complete_graph_on_four_vertices_has_three_triangles() {
        let edges = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
        assert_eq!(minimum_cycle_basis(4, &edges), [3, 3, 3]);
    }

    #[test]
    fn a_tree_has_none() {
        assert!(minimum_cycle_basis(3, &[(0, 1), (1, 2)]).is_empty());
    }
}
