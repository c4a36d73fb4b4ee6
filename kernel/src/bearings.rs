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

/// Much more than the difference of any two exponents.
const FAR: f64 = 1e9;

/// What is known of the direction of the places of a block, in memory [`Bearings::numbers`] of them: the unit vector, zero at the
/// start itself, then `w + z` and `(w + z)^2 / (c + z)`.
#[derive(Clone, Debug)]
pub struct Bearings {
    dimensions: usize,
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
        Self { dimensions, blocks: Vec::with_capacity(blocks * (dimensions + 2)) }
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
    pub fn extend(&mut self, places: &Places<'_>, covariance: Option<&Symmetric>, origin: &Origin) {
        match self.dimensions {
            1 => self.append::<1>(places, covariance, origin),
            2 => self.append::<2>(places, covariance, origin),
            _ => self.append::<3>(places, covariance, origin),
        }
    }

    fn append<const D: usize>(&mut self, places: &Places<'_>, covariance: Option<&Symmetric>, origin: &Origin) {
        let s = Lanes::splat;
        let mut push = |lanes: Lanes| {
            let mut block = Block::default();
            lanes.store(&mut block);
            self.blocks.push(block);
        };
        for i in 0..places.coordinates[0].len() {
            let mut unit = [s(0.0); AXES];
            let mut square = s(0.0);
            for axis in 0..D {
                unit[axis] = Lanes::load(&places.coordinates[axis][i]) - s(origin.start[axis]);
                square = square + unit[axis] * unit[axis];
            }
            let over = s(1.0) / square.at_least(s(f64::MIN_POSITIVE)).sqrt();
            unit = unit.map(|component| component * over);
            let own = |axis: usize| places.variances[axis].get(i).map_or(s(0.0), Lanes::load);
            let covariance = match covariance {
                Some(covariance) => covariance.map(s),
                None => [own(0), s(0.0), own(1), s(0.0), s(0.0), own(2)],
            };
            // what is at the start itself lies in no direction
            let nowhere = (s(1.0) - square * s(f64::MIN_POSITIVE.recip())).at_least(s(0.0));
            // distance / (distance^2 + 1)
            let shrunk = square * over / (square + s(1.0));
            let variance = across::<D>(&covariance, unit) * shrunk * shrunk + nowhere * s(NO_DIRECTION);
            let wide = s(origin.wide) + variance;
            unit.into_iter().take(D).for_each(&mut push);
            push(wide);
            push(wide * wide / (s(origin.core) + variance));
        }
    }

    /// Turns the sums `N_i / S_i` of the places from block `first` on into the exponents `power log2(N_i / S_i) + log2 B_i`, and
    /// returns the largest, and the largest of those whose sums may have been cut off.
    #[inline(never)]
    pub fn exponents(&self, first: usize, way: &Way, sums: &mut [Block]) -> (f64, f64) {
        let bearings = self.blocks.get(first * (self.dimensions + 2)..).unwrap_or_default();
        match self.dimensions {
            1 => exponents::<1, 3>(bearings.as_chunks().0, way, sums),
            2 => exponents::<2, 4>(bearings.as_chunks().0, way, sums),
            _ => exponents::<3, 5>(bearings.as_chunks().0, way, sums),
        }
    }
}

/// `(trace S - u'S u) / (d - 1)` along the unit vector `u`, multiplied out, so that nothing large is subtracted; zero on a line.
#[inline(always)]
fn across<const D: usize>([xx, xy, yy, xz, yz, zz]: &Symmetric<Lanes>, [x, y, z]: [Lanes; AXES]) -> Lanes {
    if D == 1 {
        return Lanes::splat(0.0);
    }
    let (a, b, mixed) = (x * x, y * y, *xy * x * y);
    let plane = *xx * b + *yy * a - (mixed + mixed);
    if D == 2 {
        return plane;
    }
    let mixed = z * (*xz * x + *yz * y);
    Lanes::splat(0.5) * (plane + (*xx + *yy) * z * z + *zz * (a + b) - (mixed + mixed))
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
