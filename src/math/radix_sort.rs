//! Sorting by integers in a time that is linear in how many there are.

/// Sorts by the first of each pair; those that have it in common stay in their order. Digit by digit, from the last one on
/// (Knuth, The Art of Computer Programming 3, 5.2.5).
pub fn radix_sort(pairs: &mut Vec<(u64, u32)>) {
    const BITS: u32 = 8;
    let all = pairs.iter().fold(0, |all, (number, _)| all | number);
    let mut sorted = vec![(0, 0); pairs.len()];
    for shift in (0..u64::BITS - all.leading_zeros()).step_by(BITS as usize) {
        let digit = |number: u64| (number >> shift) as usize % (1 << BITS);
        let mut places = [0; 1 << BITS];
        for (number, _) in pairs.iter() {
            places[digit(*number)] += 1;
        }
        let mut end = 0;
        for place in &mut places {
            end += std::mem::replace(place, end);
        }
        for pair in pairs.iter() {
            let place = &mut places[digit(pair.0)];
            sorted[*place] = *pair;
            *place += 1;
        }
        std::mem::swap(pairs, &mut sorted);
    }
}

/// Sorts numbers in the order of [`f64::total_cmp`], whose integers are the bits, all of them turned over where the sign is set.
/// The standard library's sorts would be linked in for this alone.
pub fn sort_numbers(numbers: &mut [f64]) {
    const SIGN: u64 = 1 << 63;
    let turned = |bits: u64| if bits & SIGN == 0 { bits | SIGN } else { !bits };
    let mut pairs: Vec<(u64, u32)> = numbers.iter().map(|x| (turned(x.to_bits()), 0)).collect();
    radix_sort(&mut pairs);
    for (number, (key, _)) in numbers.iter_mut().zip(pairs) {
        *number = f64::from_bits(if key & SIGN == 0 { !key } else { key ^ SIGN });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_in_their_total_order() {
        let mut numbers = [3.5, -0.0, 0.0, f64::NEG_INFINITY, -2.0, 1e-300, -1e300, f64::INFINITY, -2.0, f64::NAN];
        let mut expected = numbers;
        expected.sort_by(f64::total_cmp);
        sort_numbers(&mut numbers);
        assert_eq!(numbers.map(f64::to_bits), expected.map(f64::to_bits));
    }

    #[test]
    fn it_sorts_by_all_bits_and_keeps_the_order_of_equals() {
        let number = |i: u32| (u64::from(i).wrapping_mul(0x9e37_79b9_7f4a_7c15)) >> (i % 3 * 20) & !0xff00;
        let mut pairs: Vec<(u64, u32)> = (0..1000).map(|i| (number(i / 2), i)).collect();
        let mut expected = pairs.clone();
        expected.sort_by_key(|pair| pair.0);
        radix_sort(&mut pairs);
        assert_eq!(pairs, expected);
        assert!(pairs[999].0 > 1 << 56);
    }

    #[test]
    fn there_may_be_none_and_all_may_be_zero() {
        for mut pairs in [vec![], vec![(0, 2), (0, 1)]] {
            let before = pairs.clone();
            radix_sort(&mut pairs);
            assert_eq!(pairs, before);
        }
    }
}
