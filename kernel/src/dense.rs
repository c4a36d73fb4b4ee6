//! Matrices of any size, flat and column by column: products, roots, triangles, and Gaussians conditioned by roots.
//!
//! `math::gaussian` and `math::kalman` of `whither` explain what they are for. None is generic: a generic function is compiled in
//! the crate that calls it, for size.

pub mod filter;

use crate::small_gaussian::VANISHING;

/// Whether every number is finite.
#[inline(never)]
#[must_use]
pub fn is_finite(numbers: &[f64]) -> bool {
    numbers.iter().all(|x| x.is_finite())
}

/// A list of so many numbers; its code once, as it is long.
#[inline(never)]
pub fn resize(room: &mut Vec<f64>, length: usize) {
    room.resize(length, 0.0);
}

/// `C = A B`, with `A` of so many rows and `B` of so many.
pub fn multiply(a: &[f64], rows: usize, b: &[f64], inner: usize, c: &mut [f64]) {
    product((a, rows), (b, 1, inner), c, rows);
}

/// `C = A B'`, with `A` of so many rows and `B` of so many.
pub fn multiply_transposed(a: &[f64], rows: usize, b: &[f64], columns: usize, c: &mut [f64]) {
    product((a, rows), (b, columns, 1), c, rows);
}

/// `L L'` of `size` rows of `L`, the first of which is row `from` of `rows`.
pub fn square(root: &[f64], rows: usize, from: usize, size: usize, into: &mut [f64]) {
    let part = &root[from..];
    product((part, rows), (part, rows, 1), into, size);
}

/// `C = A B` of so many rows; how far it is from one column of `A` to the next, and from one entry of `B` to the next one down and
/// to the next one to the right.
#[inline(never)]
fn product((a, apart): (&[f64], usize), (b, down, right): (&[f64], usize, usize), c: &mut [f64], rows: usize) {
    for (j, sums) in c.chunks_exact_mut(rows).enumerate() {
        for (k, column) in a.chunks(apart).enumerate() {
            let factor = b[k * down + j * right];
            for (sum, x) in sums.iter_mut().zip(column) {
                *sum = if k == 0 { factor * x } else { *sum + factor * x };
            }
        }
    }
}

/// Copies a matrix of so many rows to where columns are so far apart.
#[inline(never)]
fn place(into: &mut [f64], apart: usize, from: &[f64], rows: usize) {
    for (to, from) in into.chunks_mut(apart).zip(from.chunks_exact(rows)) {
        to[..rows].copy_from_slice(from);
    }
}

/// `F P F' + Q`, symmetric to the bit, with `F` of so many rows.
#[inline(never)]
pub fn propagate(f: &[f64], rows: usize, p: &[f64], q: &[f64], room: &mut Vec<f64>, into: &mut [f64]) {
    resize(room, f.len());
    multiply(f, rows, p, f.len() / rows, room);
    multiply_transposed(room, rows, f, rows, into);
    into.iter_mut().zip(q).for_each(|(sum, q)| *sum += q);
    symmetrise(into, rows);
}

/// Replaces a matrix by its symmetric part.
#[inline(never)]
pub fn symmetrise(matrix: &mut [f64], size: usize) {
    for i in 0..size {
        for j in 0..i {
            let mean = 0.5 * (matrix[i + j * size] + matrix[j + i * size]);
            matrix[i + j * size] = mean;
            matrix[j + i * size] = mean;
        }
    }
}

/// A root of a positive semi-definite matrix, `P = A A'`, its columns in the order of the pivots; see `math::gaussian::root`.
#[inline(never)]
pub fn root(p: &[f64], size: usize, room: &mut Vec<f64>, into: &mut [f64]) {
    let deviation = |i: usize| if p[i + i * size] > 0.0 { p[i + i * size].sqrt() } else { 0.0 };
    resize(room, size * size);
    for (j, column) in room.chunks_exact_mut(size).enumerate() {
        for (i, x) in column.iter_mut().enumerate() {
            let scale = deviation(i) * deviation(j);
            *x = if scale == 0.0 { 0.0 } else { p[i + j * size] / scale };
        }
    }
    let left = room;
    for (column, part) in into.chunks_exact_mut(size).enumerate() {
        let pivot = (0..size).fold(0, |most, i| if left[i + i * size] > left[most + most * size] { i } else { most });
        let largest = left[pivot + pivot * size];
        if largest <= size as f64 * f64::EPSILON {
            into[column * size..].fill(0.0);
            break;
        }
        let scale = largest.sqrt();
        part.iter_mut().zip(&left[pivot * size..]).for_each(|(part, x)| *part = x / scale);
        for (j, rest) in left.chunks_exact_mut(size).enumerate() {
            rest.iter_mut().zip(&*part).for_each(|(rest, x)| *rest -= part[j] * x);
            rest[pivot] = 0.0;
        }
        left[pivot * size..(pivot + 1) * size].fill(0.0);
    }
    for column in into.chunks_exact_mut(size) {
        column.iter_mut().enumerate().for_each(|(i, x)| *x *= deviation(i));
    }
}

/// Replaces a matrix of so many rows by the lower triangle with the same square, its diagonal not negative: reflections from the
/// right, row by row.
#[inline(never)]
pub fn triangularise(a: &mut [f64], rows: usize, room: &mut Vec<f64>) {
    let columns = a.len() / rows;
    resize(room, rows + columns);
    let (dots, reflector) = room.split_at_mut(rows);
    for i in 0..rows.min(columns) {
        let mut square = 0.0;
        for (x, column) in reflector[i..].iter_mut().zip(a[i * rows..].chunks_exact_mut(rows)) {
            *x = column[i];
            square += *x * *x;
            column[i] = 0.0;
        }
        let norm = square.sqrt();
        if norm < VANISHING {
            continue;
        }
        let pivot = reflector[i];
        let sign = if pivot > 0.0 { -1.0 } else { 1.0 };
        reflector[i] = pivot - sign * norm;
        let scale = 1.0 / (norm * (norm + pivot.abs()));
        let dots = &mut dots[i + 1..];
        for (k, (x, column)) in reflector[i..].iter().zip(a[i * rows..].chunks_exact(rows)).enumerate() {
            let below = dots.iter_mut().zip(&column[i + 1..]);
            if k == 0 {
                below.for_each(|(dot, y)| *dot = y * x);
            } else {
                below.for_each(|(dot, y)| *dot += y * x);
            }
        }
        dots.iter_mut().for_each(|dot| *dot *= scale);
        for (x, column) in reflector[i..].iter().zip(a[i * rows..].chunks_exact_mut(rows)) {
            column[i + 1..].iter_mut().zip(&*dots).for_each(|(y, dot)| *y -= dot * x);
        }
        // the reflected row's sign is turned with the column's, so that the diagonal is not negative
        let column = &mut a[i * (rows + 1)..(i + 1) * rows];
        column.iter_mut().for_each(|x| *x *= sign);
        column[0] = norm;
    }
}

/// Replaces a positive definite matrix by its lower triangular root, Cholesky's; false where it is not one.
#[inline(never)]
#[must_use]
pub fn cholesky(matrix: &mut [f64], size: usize) -> bool {
    for j in 0..size {
        let (before, from) = matrix.split_at_mut(j * size);
        let column = &mut from[..size];
        column[..j].fill(0.0);
        for other in before.chunks_exact(size) {
            let factor = other[j];
            column[j..].iter_mut().zip(&other[j..]).for_each(|(x, y)| *x -= factor * y);
        }
        let pivot = column[j];
        if !(pivot > 0.0) {
            return false;
        }
        let diagonal = pivot.sqrt();
        column[j] = diagonal;
        column[j + 1..].iter_mut().for_each(|x| *x /= diagonal);
    }
    true
}

/// Replaces `b` by `L^-1 b`, column by column; the upper triangle of `L`, whose columns are so far apart, is not read.
#[inline(never)]
pub fn solve_lower(root: &[f64], stride: usize, size: usize, b: &mut [f64]) {
    for column in b.chunks_exact_mut(size) {
        for (j, part) in root.chunks(stride).enumerate().take(size) {
            let (first, rest) = column[j..].split_at_mut(1);
            first[0] /= part[j];
            rest.iter_mut().zip(&part[j + 1..]).for_each(|(x, y)| *x -= first[0] * y);
        }
    }
}

/// `b' S^-1 b` with `S = L L'`; `b` becomes `L^-1 b`.
#[inline(never)]
pub fn squared_distance(root: &[f64], stride: usize, b: &mut [f64]) -> f64 {
    solve_lower(root, stride, b.len(), b);
    b.iter().map(|z| z * z).sum()
}

/// Replaces `b` by `L'^-1 b`, column by column.
#[inline(never)]
pub fn solve_upper(root: &[f64], size: usize, b: &mut [f64]) {
    for column in b.chunks_exact_mut(size) {
        for (j, part) in root.chunks_exact(size).enumerate().rev() {
            let mut left = column[j];
            for (x, y) in column[j + 1..].iter().zip(&part[j + 1..]) {
                left -= x * y;
            }
            column[j] = left / part[j];
        }
    }
}

/// A covariance of `size` components conditioned on an observation of `observed`, in one array.
///
/// An orthogonal transformation turns
/// ```text
/// | R^1/2  H L |          | S^1/2      0  |
/// |   0     L  |   into   | K S^1/2    L+ |
/// ```
/// and then `K S^1/2` becomes `K`.
#[derive(Clone, Debug, Default)]
pub struct Conditioning {
    size: usize,
    observed: usize,
    array: Vec<f64>,
    room: Vec<f64>,
    product: Vec<f64>,
}

impl Conditioning {
    /// Conditions `L L'` on `z = H x + v`, `v ~ N(0, R)`, where `H`, with `observed` rows, is of the last components; whether
    /// the prediction error's covariance is regular.
    #[inline(never)]
    #[must_use]
    pub fn set(&mut self, l: &[f64], size: usize, h: &[f64], r: &[f64], observed: usize) -> bool {
        let (rows, known) = (size + observed, h.len() / observed);
        (self.size, self.observed) = (size, observed);
        self.array.clear();
        resize(&mut self.array, rows * rows);
        resize(&mut self.product, observed * size.max(observed));
        let (array, product) = (&mut self.array, &mut self.product);
        root(r, observed, &mut self.room, &mut product[..observed * observed]);
        place(array, rows, &product[..observed * observed], observed);
        self::product((h, observed), (&l[size - known..], 1, size), &mut product[..observed * size], observed);
        place(&mut array[observed * rows..], rows, &product[..observed * size], observed);
        place(&mut array[observed * (rows + 1)..], rows, l, size);
        triangularise(array, rows, &mut self.room);
        // the last column first
        for j in (0..observed).rev() {
            let (to, others) = self.array[j * rows..].split_at_mut(rows);
            let (triangle, gain) = to.split_at_mut(observed);
            for (other, factor) in others.chunks_exact(rows).zip(&triangle[j + 1..observed]) {
                gain.iter_mut().zip(&other[observed..]).for_each(|(x, y)| *x -= y * factor);
            }
            gain.iter_mut().for_each(|x| *x /= triangle[j]);
        }
        self.log_root().is_finite()
    }

    /// `ln det S^1/2`.
    fn log_root(&self) -> f64 {
        let rows = self.size + self.observed;
        (0..self.observed).map(|i| self.array[i * (rows + 1)].ln()).sum()
    }

    fn columns(&self) -> impl Iterator<Item = (&[f64], &[f64])> {
        self.array.chunks_exact(self.size + self.observed).map(|column| column.split_at(self.observed))
    }

    /// `S^1/2`.
    pub fn prediction_error(&self) -> impl Iterator<Item = f64> {
        self.columns().take(self.observed).flat_map(|(upper, _)| upper).copied()
    }

    /// `K`.
    pub fn gain(&self) -> impl Iterator<Item = f64> {
        self.columns().take(self.observed).flat_map(|(_, lower)| lower).copied()
    }

    /// `L+`, lower triangular.
    pub fn root(&self) -> impl Iterator<Item = f64> {
        self.columns().skip(self.observed).flat_map(|(_, lower)| lower).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, dmatrix};

    fn lower(matrix: &DMatrix<f64>) -> bool {
        let n = matrix.nrows();
        (0..n).all(|i| matrix[(i, i)] >= 0.0 && (i + 1..n).all(|j| matrix[(i, j)] == 0.0))
    }

    #[test]
    fn products_are_those_of_matrices() {
        let (a, b) = (dmatrix![1.0, 2.0, 3.0; 4.0, 5.0, 6.0], dmatrix![0.5, -1.0; 2.0, 3.0; -0.25, 7.0]);
        let mut found = DMatrix::zeros(2, 2);
        multiply(a.as_slice(), 2, b.as_slice(), 3, found.as_mut_slice());
        assert_eq!(found, &a * &b);
        multiply_transposed(a.as_slice(), 2, b.transpose().as_slice(), 2, found.as_mut_slice());
        assert_eq!(found, &a * &b);
        let mut part = [0.0];
        square(b.as_slice(), 3, 1, 1, &mut part);
        assert_eq!(part, [13.0]);
        let p = dmatrix![2.0, 0.5, 0.0; 0.5, 1.0, 0.1; 0.0, 0.1, 3.0];
        let q = dmatrix![1.0, 0.5; 0.5, 2.0];
        propagate(a.as_slice(), 2, p.as_slice(), q.as_slice(), &mut Vec::new(), found.as_mut_slice());
        assert!((&found - (&a * p * a.transpose() + q)).amax() < 1e-13);
    }

    #[test]
    fn triangles_and_roots_keep_the_square() {
        let wide = dmatrix![1.0, -2.0, 0.5, 3.0; 0.25, 4.0, -1.0, 2.0; 1.5, 0.0, 2.0, -1.0];
        let mut numbers = wide.as_slice().to_vec();
        triangularise(&mut numbers, 3, &mut Vec::new());
        let triangle = DMatrix::from_column_slice(3, 3, &numbers[..9]);
        assert!(lower(&triangle) && numbers[9..].iter().all(|x| *x == 0.0), "{triangle}");
        let square = &wide * wide.transpose();
        assert!((&triangle * triangle.transpose() - &square).amax() < 1e-13);

        let mut factor = square.clone();
        assert!(cholesky(factor.as_mut_slice(), 3) && lower(&factor));
        assert!((&factor - square.clone().cholesky().unwrap().l()).amax() < 1e-13);
        let mut solved = wide.clone();
        solve_lower(factor.as_slice(), 3, 3, solved.as_mut_slice());
        let distance = squared_distance(factor.as_slice(), 3, &mut [1.0, -2.0, 0.5]);
        let b = nalgebra::dvector![1.0, -2.0, 0.5];
        assert!((distance - b.dot(&(square.clone().try_inverse().unwrap() * &b))).abs() < 1e-12);
        solve_upper(factor.as_slice(), 3, solved.as_mut_slice());
        assert!((square.clone() * solved - &wide).amax() < 1e-12);
        assert!(!cholesky(&mut [1.0, 2.0, 2.0, 1.0], 2) && !cholesky(&mut [f64::NAN], 1));

        // the third component is nothing, and the second twice the first: what is left is rounding
        let semidefinite = dmatrix![4.0, 8.0, 0.0; 8.0, 16.0, 0.0; 0.0, 0.0, 0.0];
        let mut found = DMatrix::from_element(3, 3, f64::NAN);
        root(semidefinite.as_slice(), 3, &mut Vec::new(), found.as_mut_slice());
        assert!((&found * found.transpose() - semidefinite).amax() < 1e-14);
    }

    #[test]
    fn conditioning_is_that_of_joint_gaussians() {
        let root = dmatrix![2.0, 0.0, 0.0; 0.5, 1.0, 0.0; -0.3, 0.7, 1.5];
        let (h, r) = (dmatrix![1.0, 0.5; 0.0, 2.0], dmatrix![0.5, 0.2; 0.2, 0.4]);
        let mut conditioning = Conditioning::default();
        assert!(conditioning.set(root.as_slice(), 3, h.as_slice(), r.as_slice(), 2));
        // it is of the last two components
        let all = dmatrix![0.0, 1.0, 0.5; 0.0, 0.0, 2.0];
        let p = &root * root.transpose();
        let s = &all * &p * all.transpose() + r;
        let gain = &p * all.transpose() * s.clone().try_inverse().unwrap();
        let found = DMatrix::from_iterator(2, 2, conditioning.prediction_error());
        assert!(lower(&found) && (&found * found.transpose() - &s).amax() < 1e-13);
        assert!((DMatrix::from_iterator(3, 2, conditioning.gain()) - &gain).amax() < 1e-13);
        let found = DMatrix::from_iterator(3, 3, conditioning.root());
        assert!(lower(&found) && (&found * found.transpose() - (&p - &gain * s * gain.transpose())).amax() < 1e-13);
        assert!(!conditioning.set(&[0.0], 1, &[1.0], &[0.0], 1), "it has no density");
    }
}
