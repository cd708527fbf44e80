//! A direct solver for complex symmetric matrices on a grid whose points are coupled with their eight neighbours.
//!
//! The points are eliminated in the order of nested dissection (George 1973): lines that separate the grid into halves
//! come after the halves. Each separator is one dense matrix with the points around its region (a front). A grid of n x
//! n points takes about 10 n^3 multiplications and 8 n^2 log2(n) stored numbers instead of the n^4 and n^3 of a band.

use crate::coast::complex::Complex;
use std::sync::Arc;

/// Number of right-hand sides that are solved together.
pub(super) const LANES: usize = 8;
/// Regions up to this number of points are eliminated at once.
const LEAF_POINTS: usize = 20;
/// Columns of a front that are eliminated together.
const BLOCK: usize = 4;

/// A complex symmetric matrix: each point's entry on the diagonal, and those with four of its neighbours.
#[derive(Clone, Debug)]
pub(super) struct Stencil {
    pub(super) columns: usize,
    pub(super) diagonal: Vec<Complex>,
    /// Entries between a point (i, j) and the points (i + 1, j), (i - 1, j + 1), (i, j + 1) and (i + 1, j + 1).
    pub(super) forward: Vec<[Complex; 4]>,
}

impl Stencil {
    pub(super) fn zeros(columns: usize, rows: usize) -> Self {
        let points = columns * rows;
        Self { columns, diagonal: vec![Complex::ZERO; points], forward: vec![[Complex::ZERO; 4]; points] }
    }

    /// Adds `value` to the entries (a, b) and (b, a) of two neighbouring points with a below b, or to (a, a) once.
    pub(super) fn add(&mut self, a: usize, b: usize, value: Complex) {
        if a == b {
            self.diagonal[a] += value;
        } else {
            let slot = self.slot(a, b);
            self.forward[a][slot] += value;
        }
    }

    fn slot(&self, a: usize, b: usize) -> usize {
        if b == a + 1 { 0 } else { b + 2 - a - self.columns }
    }

    /// The entry between two neighbours.
    fn entry(&self, a: usize, b: usize) -> Complex {
        let (a, b) = (a.min(b), a.max(b));
        self.forward[a][self.slot(a, b)]
    }

    /// The product of the matrix with a vector.
    pub(super) fn times(&self, x: &[Complex]) -> Vec<Complex> {
        let mut out: Vec<Complex> = self.diagonal.iter().zip(x).map(|(d, x)| *d * *x).collect();
        for (a, entries) in self.forward.iter().enumerate() {
            for (slot, value) in entries.iter().enumerate().filter(|(_, value)| **value != Complex::ZERO) {
                let b = if slot == 0 { a + 1 } else { a + self.columns + slot - 2 };
                out[a] += *value * x[b];
                out[b] += *value * x[a];
            }
        }
        out
    }
}

/// The order of elimination of the points of a grid.
pub(super) struct Dissection {
    columns: usize,
    rows: usize,
    /// Fronts in the order of their elimination: children before their parents.
    fronts: Vec<Front>,
    /// Place of each point in the order of elimination.
    place: Vec<usize>,
}

struct Front {
    /// The points that it eliminates, followed by those around its region, which are eliminated later.
    points: Vec<usize>,
    /// Number of points that it eliminates.
    own: usize,
    children: Vec<usize>,
}

impl Dissection {
    pub(super) fn new(columns: usize, rows: usize) -> Self {
        let mut out = Self { columns, rows, fronts: Vec::new(), place: vec![0; columns * rows] };
        out.divide([0, columns], [0, rows]);
        let mut next = 0;
        for front in &out.fronts {
            for point in &front.points[..front.own] {
                out.place[*point] = next;
                next += 1;
            }
        }
        out
    }

    /// Adds the fronts of the region with the given ranges of columns and rows; returns the index of the last.
    fn divide(&mut self, x: [usize; 2], y: [usize; 2]) -> usize {
        let (width, height) = (x[1] - x[0], y[1] - y[0]);
        let (mut points, mut children) = (Vec::new(), Vec::new());
        if width * height <= LEAF_POINTS || width.max(height) < 3 {
            points.extend((y[0]..y[1]).flat_map(|j| (x[0]..x[1]).map(move |i| (i, j))));
        } else if width >= height {
            let middle = x[0] + width / 2;
            children = vec![self.divide([x[0], middle], y), self.divide([middle + 1, x[1]], y)];
            points.extend((y[0]..y[1]).map(|j| (middle, j)));
        } else {
            let middle = y[0] + height / 2;
            children = vec![self.divide(x, [y[0], middle]), self.divide(x, [middle + 1, y[1]])];
            points.extend((x[0]..x[1]).map(|i| (i, middle)));
        }
        let own = points.len();
        let (low, high) = ([x[0].saturating_sub(1), y[0].saturating_sub(1)], [x[1] + 1, y[1] + 1]);
        for j in low[1]..high[1].min(self.rows) {
            for i in low[0]..high[0].min(self.columns) {
                let inside = i >= x[0] && i < x[1] && j >= y[0] && j < y[1];
                if !inside {
                    points.push((i, j));
                }
            }
        }
        let columns = self.columns;
        let points = points.into_iter().map(|(i, j)| j * columns + i).collect();
        self.fronts.push(Front { points, own, children });
        self.fronts.len() - 1
    }
}

/// Multiplications of a step of [`Factorisation`], some milliseconds of work.
const STEP_PRODUCTS: usize = 4_000_000;

/// The factors L D L^T of a matrix.
pub(super) struct Factors {
    dissection: Arc<Dissection>,
    /// For each front, the reciprocals of its pivots and the columns of L below the diagonal, one after the other.
    pivots: Vec<Vec<Complex>>,
    lower: Vec<Vec<Complex>>,
}

/// The upper triangle of a symmetric matrix by rows, real and imaginary parts apart for the CPU's vector units.
struct Dense {
    size: usize,
    re: Vec<f64>,
    im: Vec<f64>,
}

impl Dense {
    fn zeros(size: usize) -> Self {
        Self { size, re: vec![0.0; size * size], im: vec![0.0; size * size] }
    }

    fn at(&self, a: usize, b: usize) -> Complex {
        let index = a * self.size + b;
        Complex::new(self.re[index], self.im[index])
    }

    fn add(&mut self, a: usize, b: usize, value: Complex) {
        let index = a.min(b) * self.size + a.max(b);
        self.re[index] += value.re;
        self.im[index] += value.im;
    }

    /// Subtracts from row `row`, right of its diagonal, the rows `first..first + factors.len()` times `factors`.
    fn subtract_rows(&mut self, row: usize, first: usize, factors: &[Complex]) {
        let size = self.size;
        let (re_above, re_row) = self.re.split_at_mut(row * size);
        let (im_above, im_row) = self.im.split_at_mut(row * size);
        let (re, im) = (&mut re_row[row..size], &mut im_row[row..size]);
        let part = |k: usize| {
            let range = (first + k) * size + row..(first + k + 1) * size;
            (&re_above[range.clone()], &im_above[range])
        };
        if let [a, b, c, d] = *factors {
            let ((ar, ai), (br, bi), (cr, ci), (dr, di)) = (part(0), part(1), part(2), part(3));
            let n = re.len();
            // Equal lengths let the compiler leave out the checks of the indices.
            let (im, ar, ai, br, bi) = (&mut im[..n], &ar[..n], &ai[..n], &br[..n], &bi[..n]);
            let (cr, ci, dr, di) = (&cr[..n], &ci[..n], &dr[..n], &di[..n]);
            for j in 0..n {
                re[j] -= (a.re * ar[j] - a.im * ai[j])
                    + (b.re * br[j] - b.im * bi[j])
                    + (c.re * cr[j] - c.im * ci[j])
                    + (d.re * dr[j] - d.im * di[j]);
                im[j] -= (a.re * ai[j] + a.im * ar[j])
                    + (b.re * bi[j] + b.im * br[j])
                    + (c.re * ci[j] + c.im * cr[j])
                    + (d.re * di[j] + d.im * dr[j]);
            }
            return;
        }
        for (k, f) in factors.iter().enumerate() {
            let (fr, fi) = part(k);
            for (((re, im), r), i) in re.iter_mut().zip(im.iter_mut()).zip(fr).zip(fi) {
                *re -= f.re * r - f.im * i;
                *im -= f.re * i + f.im * r;
            }
        }
    }

    /// Eliminates the first `own` rows; what remains below is the Schur complement. Returns the reciprocals of the
    /// pivots and the columns of L.
    fn eliminate(&mut self, own: usize) -> (Vec<Complex>, Vec<Complex>) {
        let mut pivots = Vec::with_capacity(own);
        let mut first = 0;
        while first < own {
            let end = (first + BLOCK).min(own);
            for row in first..end {
                let factors: Vec<Complex> = (first..row).map(|k| self.at(k, row) * pivots[k]).collect();
                for (k, factor) in factors.into_iter().enumerate() {
                    self.subtract_rows(row, first + k, &[factor]);
                }
                pivots.push(self.at(row, row).recip());
            }
            for row in end..self.size {
                let mut factors = [Complex::ZERO; BLOCK];
                for k in first..end {
                    factors[k - first] = self.at(k, row) * pivots[k];
                }
                self.subtract_rows(row, first, &factors[..end - first]);
            }
            first = end;
        }
        let mut lower = Vec::with_capacity(own * self.size - own * (own + 1) / 2);
        for (k, pivot) in pivots.iter().enumerate() {
            lower.extend((k + 1..self.size).map(|j| self.at(k, j) * *pivot));
        }
        (pivots, lower)
    }
}

/// A matrix that is being factorised.
pub(super) struct Factorisation {
    matrix: Stencil,
    factors: Factors,
    /// Place of each point in the present front.
    local: Vec<usize>,
    /// For each front that is factorised: its Schur complement, which its parent front adds up.
    complements: Vec<Option<Dense>>,
}

impl Factorisation {
    /// Prepares the factorisation of `matrix` without exchanging rows: absorbing borders keep the pivots away from 0.
    pub(super) fn new(dissection: &Arc<Dissection>, matrix: Stencil) -> Self {
        let factors = Factors { dissection: dissection.clone(), pivots: Vec::new(), lower: Vec::new() };
        Self { matrix, factors, local: vec![usize::MAX; dissection.place.len()], complements: Vec::new() }
    }

    /// Eliminates some fronts. Returns the fraction that is done, 1 at the end.
    pub(super) fn step(&mut self) -> f64 {
        let dissection = self.factors.dissection.clone();
        let mut products = 0;
        while self.complements.len() < dissection.fronts.len() && products < STEP_PRODUCTS {
            let front = &dissection.fronts[self.complements.len()];
            self.eliminate(&dissection, front);
            products += front.own * front.points.len() * front.points.len();
        }
        self.complements.len() as f64 / dissection.fronts.len() as f64
    }

    /// The factors, after the last step.
    pub(super) fn finish(self) -> Factors {
        self.factors
    }

    fn eliminate(&mut self, dissection: &Dissection, front: &Front) {
        for (index, point) in front.points.iter().enumerate() {
            self.local[*point] = index;
        }
        let mut dense = Dense::zeros(front.points.len());
        self.factors.add_entries(front, &self.matrix, &self.local, &mut dense);
        for child in &front.children {
            let Some(complement) = self.complements[*child].take() else { continue };
            let child = &dissection.fronts[*child];
            let places: Vec<usize> = child.points.iter().map(|point| self.local[*point]).collect();
            for a in child.own..child.points.len() {
                for b in a..child.points.len() {
                    dense.add(places[a], places[b], complement.at(a, b));
                }
            }
        }
        let (pivots, lower) = dense.eliminate(front.own);
        self.factors.pivots.push(pivots);
        self.factors.lower.push(lower);
        self.complements.push(Some(dense));
    }
}

impl Factors {
    /// Adds the entries of `matrix` between the points that `front` eliminates and all that come later.
    fn add_entries(&self, front: &Front, matrix: &Stencil, local: &[usize], dense: &mut Dense) {
        let (columns, rows) = (self.dissection.columns, self.dissection.rows);
        let place = &self.dissection.place;
        for (index, &point) in front.points[..front.own].iter().enumerate() {
            dense.add(index, index, matrix.diagonal[point]);
            let (i, j) = (point % columns, point / columns);
            for y in j.saturating_sub(1)..(j + 2).min(rows) {
                for x in i.saturating_sub(1)..(i + 2).min(columns) {
                    let other = y * columns + x;
                    if place[other] > place[point] {
                        dense.add(index, local[other], matrix.entry(point, other));
                    }
                }
            }
        }
    }

    /// Solves the systems of [`LANES`] right-hand sides in place. Each point has the real parts of all of them,
    /// followed by the imaginary parts.
    pub(super) fn solve(&self, x: &mut [[f64; 2 * LANES]]) {
        for ((front, pivots), lower) in self.dissection.fronts.iter().zip(&self.pivots).zip(&self.lower) {
            let mut column = &lower[..];
            for k in 0..pivots.len() {
                let here = x[front.points[k]];
                let (entries, rest) = column.split_at(front.points.len() - k - 1);
                for (entry, point) in entries.iter().zip(&front.points[k + 1..]) {
                    subtract_product(&mut x[*point], *entry, &here);
                }
                column = rest;
            }
        }
        for ((front, pivots), lower) in self.dissection.fronts.iter().zip(&self.pivots).zip(&self.lower).rev() {
            let mut end = lower.len();
            for k in (0..pivots.len()).rev() {
                let start = end - (front.points.len() - k - 1);
                let mut sum = [0.0; 2 * LANES];
                subtract_product(&mut sum, -pivots[k], &x[front.points[k]]);
                for (entry, point) in lower[start..end].iter().zip(&front.points[k + 1..]) {
                    subtract_product(&mut sum, *entry, &x[*point]);
                }
                x[front.points[k]] = sum;
                end = start;
            }
        }
    }
}

/// Subtracts `factor` times `x` from `y`.
#[inline]
fn subtract_product(y: &mut [f64; 2 * LANES], factor: Complex, x: &[f64; 2 * LANES]) {
    for lane in 0..LANES {
        let (re, im) = (x[lane], x[LANES + lane]);
        y[lane] -= factor.re * re - factor.im * im;
        y[LANES + lane] -= factor.re * im + factor.im * re;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix like that of a Helmholtz equation with losses, and a vector: the product of both, solved, is the
    /// vector.
    #[test]
    fn the_solution_of_a_product_is_the_vector() {
        for (columns, rows) in [(1, 1), (7, 2), (13, 40), (41, 29)] {
            let mut matrix = Stencil::zeros(columns, rows);
            let wave = |n: usize| (n as f64 * 12.9898).sin();
            for j in 0..rows {
                for i in 0..columns {
                    let point = j * columns + i;
                    matrix.add(point, point, Complex::new(-3.0 + 0.2 * wave(point), 0.15));
                    let couplings =
                        [(i + 1, j, 0.8), (i, j + 1, 0.7), (i + 1, j + 1, 0.1), (i.wrapping_sub(1), j + 1, 0.2)];
                    for (x, y, value) in couplings {
                        if x < columns && y < rows {
                            matrix.add(point, y * columns + x, Complex::new(value, 0.05 * wave(point + 7)));
                        }
                    }
                }
            }
            let x: Vec<Complex> = (0..columns * rows).map(|n| Complex::new(wave(n + 3), wave(2 * n))).collect();
            let mut lanes = vec![[0.0; 2 * LANES]; columns * rows];
            for (lane, value) in lanes.iter_mut().zip(matrix.times(&x)) {
                (lane[2], lane[LANES + 2]) = (value.re, value.im);
                (lane[5], lane[LANES + 5]) = (-2.0 * value.im, 2.0 * value.re);
            }
            let dissection = Arc::new(Dissection::new(columns, rows));
            let mut factorisation = Factorisation::new(&dissection, matrix);
            while factorisation.step() < 1.0 {}
            factorisation.finish().solve(&mut lanes);
            for (lane, x) in lanes.iter().zip(&x) {
                assert!((lane[2] - x.re).abs() + (lane[LANES + 2] - x.im).abs() < 1e-9);
                assert!((lane[5] + 2.0 * x.im).abs() + (lane[LANES + 5] - 2.0 * x.re).abs() < 1e-9);
                assert_eq!(lane[0], 0.0);
            }
        }
    }
}
