//! Rays that were recorded as azimuth and elevation, in degrees, as places on a map about the middle of their targets.

use whither::study::track::Track;
use whither::{AngleUnit, RayMap};

/// The track on the map.
pub fn track(track: &Track) -> Result<Track, String> {
    let message = |error: whither::Error| error.to_string();
    if track.dimensions() != 2 {
        return Err("only azimuth and elevation have a place on a map".to_owned());
    }
    let mut middle = [0.0; 3];
    for target in &track.targets {
        middle.iter_mut().zip(direction(&target.center)).for_each(|(sum, x)| *sum += x);
    }
    let map = RayMap::about(middle, AngleUnit::Degrees).map_err(message)?;
    let mut track = track.clone();
    let centers = track.targets.iter_mut().map(|target| &mut target.center);
    for place in centers.chain(track.samples.iter_mut().map(|sample| &mut sample.position)) {
        *place = map.position(direction(place)).map_err(message)?.to_vec();
    }
    Ok(track)
}

/// Where a ray of so many degrees of azimuth and elevation points, y up and -z ahead.
fn direction(angles: &[f64]) -> [f64; 3] {
    let [azimuth, elevation] = [angles[0], angles[1]].map(f64::to_radians);
    [elevation.cos() * azimuth.sin(), elevation.sin(), -elevation.cos() * azimuth.cos()]
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn about_the_middle_of_the_targets_angles_are_as_they_are() {
        let text = r#"{"targets": [[20, 0, 5, 5], [40, 0, 5, 5]], "target": 1, "samples": [[0, 30, -90], [1, 33, 0], [2, 30, 90]]}"#;
        let given: Track = serde_json::from_str(text).unwrap();
        let mapped = track(&given).unwrap();
        let places = mapped.targets.iter().map(|t| &t.center).chain(mapped.samples.iter().map(|s| &s.position));
        for (place, expected) in places.zip([[-10.0, 0.0], [10.0, 0.0], [0.0, -90.0], [3.0, 0.0], [0.0, 90.0]]) {
            assert!(place.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{place:?} {expected:?}");
        }
    }
}
