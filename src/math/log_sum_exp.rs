//! Sums of exponentials, in logs.

/// `ln sum_i exp(v_i)`, shifted by the largest so that nothing overflows; minus infinity for nothing at all.
#[must_use]
pub fn log_sum_exp(values: &[f64]) -> f64 {
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if !largest.is_finite() {
        return largest;
    }
    largest + values.iter().map(|v| (v - largest).exp()).sum::<f64>().ln()
}

/// Replaces logarithms by the shares of their numbers in the sum, and returns the logarithm of that sum; none, and nothing
/// has changed, where it is zero or no number. The shares sum to one however large the logarithms are.
pub fn share(values: &mut [f64]) -> Option<f64> {
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if !largest.is_finite() || values.iter().any(|value| value.is_nan()) {
        return None;
    }
    values.iter_mut().for_each(|value| *value = (*value - largest).exp());
    let sum: f64 = values.iter().sum();
    values.iter_mut().for_each(|value| *value /= sum);
    Some(largest + sum.ln())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_neither_overflows_nor_loses_the_small() {
        // ln(1 + 2 + 3) and the same far out
        let values = [0.0, 2f64.ln(), 3f64.ln()];
        for shift in [0.0, -1e5, 1e5] {
            let shifted: Vec<f64> = values.iter().map(|v| v + shift).collect();
            assert!((log_sum_exp(&shifted) - shift - 6f64.ln()).abs() < 1e-10);
        }
    }

    #[test]
    fn shares_sum_to_one_however_large_the_logarithms_are() {
        let mut values = [-1e40, -1e40, f64::NEG_INFINITY];
        assert_eq!(share(&mut values), Some(-1e40 + 2f64.ln()));
        assert_eq!(values, [0.5, 0.5, 0.0]);
        assert_eq!(share(&mut [f64::NEG_INFINITY]), None);
        assert_eq!(share(&mut [0.0, f64::NAN]), None);
    }

    #[test]
    fn what_has_no_weight_adds_nothing() {
        assert_eq!(log_sum_exp(&[]), f64::NEG_INFINITY);
        assert_eq!(log_sum_exp(&[f64::NEG_INFINITY, 1.5, f64::NEG_INFINITY]), 1.5);
    }
}
