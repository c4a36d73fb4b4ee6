//! Which harbour is a vessel going to, and when will it be there? `cargo run --example vessel`

use whither::{Predictor, Scenario};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // metres and seconds; with positions in degrees, project them first
    let scenario: Scenario = serde_json::from_str(
        r#"{
            "motion": { "type": "constantVelocity", "dimensions": 2, "noise": 0.3 },
            "observation": { "noise": 5 },
            "initial": { "velocity": 8 },
            "arrival": { "type": "uniform", "from": 1200, "to": 3600 },
            "none": 0.05,
            "destinations": [
                { "id": "Cowes", "center": [9000, 0], "size": 400 },
                { "id": "Portsmouth", "center": [14000, 8000], "size": 400 }
            ]
        }"#,
    )?;
    let mut vessel = Predictor::new(&scenario);
    for minute in 0..10 {
        let time = 60.0 * f64::from(minute);
        vessel.observe(time, &[6.0 * time, 0.1 * time])?;
        let (Some(best), Some(arrival)) = (vessel.best(), vessel.arrival(None)?) else { continue };
        println!("{minute} min: {} {:.2}, there after {:.0} min", best.id, best.probability, arrival.mean / 60.0);
    }
    Ok(())
}
