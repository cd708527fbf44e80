//! Contours of a grid by marching squares.

/// The contours of `level` in a grid of `columns` points a row, as open or closed lines of points (column, row). Cells
/// with a value that is not finite have none.
pub(super) fn contours(values: &[f32], columns: usize, level: f64) -> Vec<Vec<[f64; 2]>> {
    let rows = values.len() / columns;
    let value = |i: usize, j: usize| f64::from(values[j * columns + i]) - level;
    // Crossings lie on edges: 2 (j columns + i) from point (i, j) to the next column, one more to the next row.
    let crossing = |edge: usize| {
        let (i, j) = (edge / 2 % columns, edge / 2 / columns);
        let (u, v) = if edge.is_multiple_of(2) { (i + 1, j) } else { (i, j + 1) };
        let (a, b) = (value(i, j), value(u, v));
        let t = if a == b { 0.5 } else { a / (a - b) };
        [i as f64 + t * (u - i) as f64, j as f64 + t * (v - j) as f64]
    };
    // The edges that each crossing is joined to, at most two.
    let mut joined = vec![[usize::MAX; 2]; 2 * values.len()];
    let mut join = |a: usize, b: usize| {
        for (from, to) in [(a, b), (b, a)] {
            let slot = usize::from(joined[from][0] != usize::MAX);
            joined[from][slot] = to;
        }
    };
    for j in 0..rows - 1 {
        for i in 0..columns - 1 {
            let corners = [value(i, j), value(i + 1, j), value(i + 1, j + 1), value(i, j + 1)];
            if corners.iter().any(|v| !v.is_finite()) {
                continue;
            }
            let point = j * columns + i;
            let edges = [2 * point, 2 * (point + 1) + 1, 2 * (point + columns), 2 * point + 1];
            let crossed: Vec<usize> =
                (0..4).filter(|e| (corners[*e] > 0.0) != (corners[(*e + 1) % 4] > 0.0)).map(|e| edges[e]).collect();
            match crossed[..] {
                [a, b] => join(a, b),
                // A saddle: the value in the middle says which corners hang together.
                [a, b, c, d] if (corners.iter().sum::<f64>() > 0.0) == (corners[0] > 0.0) => (join(a, b), join(c, d)).0,
                [a, b, c, d] => (join(d, a), join(b, c)).0,
                _ => {}
            }
        }
    }
    let mut seen = vec![false; joined.len()];
    let mut lines = Vec::new();
    // Open lines from their ends first, then closed ones.
    for only_ends in [true, false] {
        for start in 0..joined.len() {
            let is_end = joined[start][0] != usize::MAX && joined[start][1] == usize::MAX;
            if seen[start] || joined[start][0] == usize::MAX || only_ends && !is_end {
                continue;
            }
            let (mut line, mut at) = (vec![crossing(start)], start);
            seen[start] = true;
            while let Some(&next) = joined[at].iter().find(|next| **next != usize::MAX && !seen[**next]) {
                seen[next] = true;
                line.push(crossing(next));
                at = next;
            }
            if at != start && joined[at].contains(&start) && line.len() > 2 {
                line.push(line[0]);
            }
            lines.push(line);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cone_has_circles_and_a_slope_has_lines() {
        let cone: Vec<f32> = (0..41 * 31).map(|i| ((i % 41) as f32 - 20.0).hypot((i / 41) as f32 - 15.0)).collect();
        let rings = contours(&cone, 41, 8.3);
        assert_eq!(rings.len(), 1);
        assert_eq!(rings[0].first(), rings[0].last());
        assert!(rings[0].iter().all(|[x, y]| ((x - 20.0).hypot(y - 15.0) - 8.3).abs() < 0.05));
        let slope: Vec<f32> = (0..12 * 9).map(|i| (i % 12) as f32).collect();
        let lines = contours(&slope, 12, 4.25);
        assert_eq!((lines.len(), lines[0].len()), (1, 9));
        assert!(lines[0].iter().all(|p| (p[0] - 4.25).abs() < 1e-9));
        assert!(contours(&slope, 12, 99.0).is_empty() && contours(&[f32::NAN; 9], 3, 0.0).is_empty());
        // A saddle gives two lines that do not cross.
        assert_eq!(contours(&[1.0, -1.0, -1.0, 1.0], 2, 0.1).len(), 2);
    }
}
