//! Which of four icons is the pointer going to? `cargo run --example pointer`

use whither::{PointerOptions, PointerTarget, Predictor, pointer_scenario};

fn main() -> whither::Result<()> {
    // the centre of each icon, in pixels
    let icons = [("radio", 200.0, 200.0), ("map", 1000.0, 200.0), ("phone", 200.0, 600.0), ("seats", 1000.0, 600.0)];
    let targets = icons.map(|(id, x, y)| PointerTarget { id: id.to_owned(), x, y, width: 96.0, height: 96.0 });
    // 5% of the movements go to none of them
    let mut predictor =
        Predictor::new(&pointer_scenario(&targets, PointerOptions { none: 0.05, ..PointerOptions::default() })?);

    // from (600, 400) to the map in half a second, 60 positions a second
    for k in 0..=30 {
        let share = f64::from(k) / 30.0;
        let way = share * share * (3.0 - 2.0 * share);
        predictor.observe(f64::from(k) / 60.0, &[600.0 + 400.0 * way, 400.0 - 200.0 * way])?;
        if let Some(best) = predictor.best()
            && k % 5 == 0
        {
            println!("{:3.0}% of the time: {:5} {:.2}", 100.0 * share, best.id, best.probability);
        }
    }
    Ok(())
}
