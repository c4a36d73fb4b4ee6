//! The directions in which places lie from the start of a movement, and what the way covered since implies of them.
//!
//! With `t` the angle at the start between the way and the place, `z` the variance of the place's direction, `w` and `c` the
//! squares of the angles beyond and below which it does not matter, the evidence is
//! ```text
//! B = [(w + z + t^2)^2 (c + z) / ((w + z)^2 (c + z + t^2))]^weight
//! ```
//! All but `t` follows from the start: it is computed once a movement, and a step has one root and two divisions for each place.

use crate::mixture::{AXES, Places};
use crate::small_gaussian::Symmetric;
use crate::vectors::{Block, Lanes};

/// The variance of a direction without information. The square of none is infinite.
const NO_DIRECTION: f64 = 1e100;

/// Where `log2` of a sum is below this, it may have been cut off.
const CERTAIN: f64 = -500.0;

/// A line is a plane in which nothing lies beside it.
const PLANE: usize = 2;

/// Much more than the difference of any two exponents.
const FAR: f64 = 1e9;

/// What is known of the direction of places, block by block: the unit vector, zero at the start itself, then `w + z` and
/// `(w + z)^2 / (c + z)`.
///
/// The number of dimensions is an argument wherever it is needed: where it is a constant, nothing is compiled for others.
#[derive(Clone, Debug)]
pub struct Bearings {
    blocks: Vec<Block>,
}

/// The start of a movement, and the squares `w` and `c` of its angles.
#[derive(Clone, Copy, Debug)]
pub struct Origin {
    /// Where it began.
    pub start: [f64; AXES],
    /// `w`.
    pub wide: f64,
    /// `c`.
    pub core: f64,
}

/// How the movement has gone on since.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// The direction, of length one; zero where there is none.
    pub unit: [f64; AXES],
    /// The weight of the evidence.
    pub weight: f64,
    /// The power of the ratio of densities that it is multiplied by.
    pub power: f64,
}

impl Bearings {
    /// Room for so many blocks of places.
    #[must_use]
    pub fn with_capacity(dimensions: usize, blocks: usize) -> Self {
        Self { blocks: Vec::with_capacity(blocks * (dimensions.max(PLANE) + 2)) }
    }

    /// Forgets all places.
    pub fn clear(&mut self) {
        self.blocks.clear();
    }

    /// Whether there is none yet.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// Appends places; `covariance` is that of the endpoints of all of them, without one each has its own variances.
    #[inline(never)]
    pub fn extend(&mut self, dimensions: usize, places: &Places<'_>, covariance: Option<&Symmetric>, origin: &Origin) {
        let s = Lanes::splat;
        let share = s(if dimensions > 2 { 0.5 } else { 1.0 });
        let mut push = |lanes: Lanes| {
            let mut block = Block::default();
            lanes.store(&mut block);
            self.blocks.push(block);
        };
        for i in 0..places.coordinates[0].len() {
            let at = |list: &[Block]| list.get(i).map_or(s(0.0), Lanes::load);
            let offset = |axis: usize| at(places.coordinates[axis]) - s(origin.start[axis]);
            let [x, y, z] = [offset(0), offset(1), offset(2)];
            let square = x * x + y * y + z * z;
            let over = s(1.0) / square.at_least(s(f64::MIN_POSITIVE)).sqrt();
            let unit = [x * over, y * over, z * over];
            let covariance = match covariance {
                Some(covariance) => covariance.map(s),
                None => {
                    let own = |axis: usize| at(places.variances[axis]);
                    [own(0), s(0.0), own(1), s(0.0), s(0.0), own(2)]
                }
            };
            // what is at the start itself lies in no direction
            let nowhere = (s(1.0) - square * s(f64::MIN_POSITIVE.recip())).at_least(s(0.0));
            // distance / (distance^2 + 1)
            let shrunk = square * over / (square + s(1.0));
            let variance = share * across(&covariance, &unit) * shrunk * shrunk + nowhere * s(NO_DIRECTION);
            let wide = s(origin.wide) + variance;
            unit.into_iter().take(dimensions.max(PLANE)).for_each(&mut push);
            push(wide);
            push(wide * wide / (s(origin.core) + variance));
        }
    }

    /// Turns the sums `N_i / S_i` of the places from block `first` on into the exponents `power log2(N_i / S_i) + log2 B_i`, and
    /// returns the largest, and the largest of those whose sums may have been cut off.
    #[inline(never)]
    pub fn exponents(&self, dimensions: usize, first: usize, way: &Way, sums: &mut [Block]) -> (f64, f64) {
        let bearings = self.blocks.get(first * (dimensions.max(PLANE) + 2)..).unwrap_or_default();
        match dimensions {
            3 => exponents::<3, 5>(bearings.as_chunks().0, way, sums),
            _ => exponents::<2, 4>(bearings.as_chunks().0, way, sums),
        }
    }
}

/// `trace S - u'S u` along the unit vector `u`, multiplied out, so that nothing large is subtracted. On a line it is zero.
#[inline(always)]
fn across([xx, xy, yy, xz, yz, zz]: &Symmetric<Lanes>, [x, y, z]: &[Lanes; AXES]) -> Lanes {
    let (x, y, z) = (*x, *y, *z);
    let mixed = *xy * x * y + *xz * x * z + *yz * y * z;
    *xx * (y * y + z * z) + *yy * (x * x + z * z) + *zz * (x * x + y * y) - (mixed + mixed)
}

#[inline(always)]
fn exponents<const D: usize, const NUMBERS: usize>(
    bearings: &[[Block; NUMBERS]],
    way: &Way,
    sums: &mut [Block],
) -> (f64, f64) {
    let s = Lanes::splat;
    let (power, weight, unit) = (s(way.power), s(way.weight), way.unit.map(s));
    let (mut most, mut doubtful) = (s(f64::MIN), s(f64::MIN));
    for (bearing, exponent) in bearings.iter().zip(sums) {
        // the squared lengths of the sum of two unit vectors and of their difference
        let (mut sum, mut difference) = (s(0.0), s(0.0));
        for axis in 0..D {
            let component = Lanes::load(&bearing[axis]);
            let (together, apart) = (component + unit[axis], component - unit[axis]);
            sum = sum + together * together;
            difference = difference + apart * apart;
        }
        let angle = Lanes::squared_angle(sum, difference);
        let (wide, over) = (Lanes::load(&bearing[D]), Lanes::load(&bearing[D + 1]));
        let wider = wide + angle;
        let evidence = Lanes::log2_ratio(wider * wider, wide * wide + over * angle);
        let ratio = Lanes::load(exponent).log2();
        let product = power * ratio + weight * evidence;
        most = product.at_least(most);
        // below all that is certain unless the ratio is below `CERTAIN`
        doubtful = product.at_most(s(FAR * CERTAIN) - s(FAR) * ratio).at_least(doubtful);
        product.store(exponent);
    }
    (most.most(), doubtful.most())
}
