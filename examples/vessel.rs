//! Which harbour is a vessel going to, and when will it be there? `cargo run --example vessel`

use whither::{Arrival, Destination, Initial, Motion, Observation, Predictor, Scenario};

fn main() -> whither::Result<()> {
    // metres and seconds; with positions in degrees, project them first
    let scenario = Scenario::builder(Motion::constant_velocity(2, 0.3), Observation::deviation(5.0))
        .initial(Initial::velocity(8.0))
        .arrival(Arrival::uniform(1200.0, 3600.0))
        .none(0.05)
        .destination(Destination::new("Cowes", [9000.0, 0.0]).size(400.0))
        .destination(Destination::new("Portsmouth", [14000.0, 8000.0]).size(400.0))
        .build()?;
    let mut vessel = Predictor::new(&scenario);
    for minute in 0..10 {
        let time = 60.0 * f64::from(minute);
        vessel.observe(time, &[6.0 * time, 0.1 * time])?;
        let (Some(best), Some(arrival)) = (vessel.best(), vessel.arrival(None)?) else { continue };
        println!("{minute} min: {} {:.2}, there after {:.0} min", best.id, best.probability, arrival.mean / 60.0);
    }
    Ok(())
}
