//! Results as serde writes them.

use super::Best;
use super::arrival_time::ArrivalTime;
use super::remaining::Remaining;
use crate::math::gaussian::Gaussian;
use serde::ser::{Serialize, SerializeStruct, Serializer};

impl Serialize for Best {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Best", 3)?;
        fields.serialize_field("index", &self.index)?;
        fields.serialize_field("id", &self.id)?;
        fields.serialize_field("probability", &self.probability)?;
        fields.end()
    }
}

impl Serialize for Remaining {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Remaining", 3)?;
        fields.serialize_field("mean", &self.mean)?;
        fields.serialize_field("low", &self.low)?;
        fields.serialize_field("high", &self.high)?;
        fields.end()
    }
}

impl Serialize for ArrivalTime {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("ArrivalTime", 4)?;
        fields.serialize_field("times", &self.times)?;
        fields.serialize_field("probabilities", &self.probabilities)?;
        fields.serialize_field("mean", &self.mean)?;
        fields.serialize_field("deviation", &self.deviation)?;
        fields.end()
    }
}

/// `{ mean, covariance }`, the covariance row by row.
impl Serialize for Gaussian {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let rows: Vec<Vec<f64>> = self.covariance.row_iter().map(|row| row.iter().copied().collect()).collect();
        let mut fields = serializer.serialize_struct("Gaussian", 2)?;
        fields.serialize_field("mean", self.mean.as_slice())?;
        fields.serialize_field("covariance", &rows)?;
        fields.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    fn json(result: &impl Serialize) -> String {
        serde_json::to_string(result).unwrap()
    }

    #[test]
    fn every_field_is_written_by_its_name() {
        let best = Best { index: 1, id: "map".to_owned(), probability: 0.75 };
        assert_eq!(json(&best), r#"{"index":1,"id":"map","probability":0.75}"#);
        let remaining = Remaining { mean: 0.5, low: 0.25, high: 1.0 };
        assert_eq!(json(&remaining), r#"{"mean":0.5,"low":0.25,"high":1.0}"#);
        let arrival = ArrivalTime::from_nodes(&[(1.0, 1.0), (3.0, 1.0)]);
        let expected = r#"{"times":[1.0,3.0],"probabilities":[0.5,0.5],"mean":2.0,"deviation":1.0}"#;
        assert_eq!(json(&arrival), expected);
    }

    #[test]
    fn a_covariance_is_written_row_by_row() {
        let gaussian = Gaussian { mean: dvector![1.0, 2.0], covariance: dmatrix![4.0, 0.5; -0.5, 9.0] };
        assert_eq!(json(&gaussian), r#"{"mean":[1.0,2.0],"covariance":[[4.0,0.5],[-0.5,9.0]]}"#);
    }
}
