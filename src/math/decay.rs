//! Integrals of decaying exponentials over a step, in units of the step, exact as the rate goes to zero.
//!
//! `x = rate * step >= 0`. The closed forms cancel for small `x`; below 1 the power series is summed instead.

/// `int_0^1 e^(-x u) du = (1 - e^-x) / x`.
#[must_use]
pub fn decay(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { -(-x).exp_m1() / x }
}

/// `int_0^1 (1 - u) e^(-x u) du = (x - 1 + e^-x) / x^2`.
#[must_use]
pub fn decay_ramp(x: f64) -> f64 {
    if x >= 1.0 {
        return (1.0 - decay(x)) / x;
    }
    // sum_k (-x)^k / (k + 2)!
    let (mut term, mut sum) = (0.5, 0.0);
    for k in 0..TERMS {
        sum += term;
        term *= -x / f64::from(k + 3);
    }
    sum
}

/// `int_0^1 ((1 - e^(-x u)) / x)^2 du = (1 - 2 decay(x) + decay(2 x)) / x^2`.
#[must_use]
pub fn decay_square(x: f64) -> f64 {
    if x >= 1.0 {
        return (1.0 - 2.0 * decay(x) + decay(2.0 * x)) / (x * x);
    }
    // sum_k (-x)^k (2^(k + 2) - 2) / (k + 3)!
    let (mut term, mut power, mut sum) = (1.0 / 6.0, 4.0, 0.0);
    for k in 0..TERMS {
        sum += term * (power - 2.0);
        power *= 2.0;
        term *= -x / f64::from(k + 4);
    }
    sum
}

/// Enough for `2^k / k!` to vanish against one.
const TERMS: u32 = 26;

#[cfg(test)]
mod tests {
    use super::*;

    /// `x`, then the three integrals computed with 50 digits (mpmath).
    const EXPECTED: [[f64; 4]; 11] = [
        [1e-300, 1.0, 0.5, 0.3333333333333333],
        [1e-9, 0.9999999995, 0.4999999998333333, 0.33333333308333335],
        [0.001, 0.9995001666250083, 0.4998333749916681, 0.33308344995834566],
        [0.1, 0.9516258196404043, 0.4837418035959573, 0.309459532928217],
        [0.5, 0.7869386805747332, 0.4261226388505337, 0.23297279071636548],
        [0.999, 0.6323848802666037, 0.36798310283623253, 0.16819598042175096],
        [1.0, 0.6321205588285577, 0.36787944117144233, 0.1680912407245783],
        [1.001, 0.6318563979933132, 0.36777582618050636, 0.1679865857522121],
        [3.0, 0.3167376438773787, 0.22775411870754045, 0.05919758372768129],
        [30.0, 0.03333333333333022, 0.032222222222222326, 0.0010555555555555624],
        [1000.0, 0.001, 0.000999, 9.985e-07],
    ];

    #[test]
    fn all_three_agree_with_values_of_50_digits() {
        for [x, once, ramp, square] in EXPECTED {
            for (name, found, expected) in
                [("decay", decay(x), once), ("ramp", decay_ramp(x), ramp), ("square", decay_square(x), square)]
            {
                assert!((found / expected - 1.0).abs() < 4e-15, "{name}({x}) = {found}, not {expected}");
            }
        }
    }
}
