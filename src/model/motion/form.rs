//! [`Motion`] as scenarios have it, `{ "type", "dimensions", ... }`.

use super::super::matrix::Matrix;
use super::super::per_axis::PerAxis;
use super::{Motion, MotionNoise, check_dimensions};
use crate::error::Result;
use crate::value::{Fields, Node, Value};

/// Reads one `type` from its keys and the dimensions.
type Read = fn(&Fields<'_>, usize) -> Result<Motion>;

/// Every `type`, its keys, and how it is read.
const TYPES: [(&str, (&[&str], Read)); 7] = [
    (
        "brownian",
        (&["type", "dimensions", "noise"], |fields, dimensions| {
            Ok(Motion::Brownian { dimensions, noise: noise(fields, dimensions)? })
        }),
    ),
    (
        "constantVelocity",
        (&["type", "dimensions", "noise", "speedNoise"], |fields, dimensions| {
            let speed_noise = fields.optional("speedNoise").map(|growth| growth.float()).transpose();
            Ok(Motion::ConstantVelocity { dimensions, noise: noise(fields, dimensions)?, speed_noise: speed_noise? })
        }),
    ),
    (
        "constantAcceleration",
        (&["type", "dimensions", "noise"], |fields, dimensions| {
            Ok(Motion::ConstantAcceleration { dimensions, noise: noise(fields, dimensions)? })
        }),
    ),
    (
        "integratedOrnsteinUhlenbeck",
        (&["type", "dimensions", "noise", "damping", "drift"], |fields, dimensions| {
            let noise = noise(fields, dimensions)?;
            let damping = fields.float("damping")?;
            let drift =
                fields.optional("drift").map_or(Ok(PerAxis::All(0.0)), |drift| PerAxis::read(&drift, dimensions))?;
            Ok(Motion::IntegratedOrnsteinUhlenbeck { dimensions, noise, damping, drift })
        }),
    ),
    (
        "meanReverting",
        (&["type", "dimensions", "noise", "rate"], |fields, dimensions| {
            Ok(Motion::MeanReverting { dimensions, noise: noise(fields, dimensions)?, rate: fields.float("rate")? })
        }),
    ),
    (
        "equilibriumRevertingVelocity",
        (&["type", "dimensions", "noise", "stiffness", "damping"], |fields, dimensions| {
            let noise = noise(fields, dimensions)?;
            let (stiffness, damping) = (fields.float("stiffness")?, fields.float("damping")?);
            Ok(Motion::EquilibriumRevertingVelocity { dimensions, noise, stiffness, damping })
        }),
    ),
    (
        "custom",
        (&["type", "dimensions", "drift", "offset", "destinationGain", "diffusion"], |fields, dimensions| {
            Ok(Motion::Custom {
                dimensions,
                drift: Matrix::read(&fields.required("drift")?)?,
                diffusion: Matrix::read(&fields.required("diffusion")?)?,
                offset: fields.optional("offset").map(|offset| offset.floats()).transpose()?,
                destination_gain: fields.optional("destinationGain").map(|gain| Matrix::read(&gain)).transpose()?,
            })
        }),
    ),
];

fn noise(fields: &Fields<'_>, dimensions: usize) -> Result<MotionNoise> {
    MotionNoise::read(&fields.required("noise")?, dimensions)
}

impl Motion {
    pub(crate) fn read(node: &Node<'_>) -> Result<Self> {
        let (keys, read) = node.tag("type", &TYPES)?;
        let fields = node.fields(keys)?;
        let dimensions = fields.required("dimensions")?;
        read(&fields, check_dimensions(dimensions.place(), dimensions.float()?)?)
    }

    pub(crate) fn to_value(&self) -> Value {
        let number = Value::Number;
        let (name, dimensions, others) = match self {
            Self::Brownian { dimensions, .. } => ("brownian", dimensions, vec![]),
            Self::ConstantVelocity { dimensions, speed_noise, .. } => {
                ("constantVelocity", dimensions, vec![("speedNoise", speed_noise.map(number))])
            }
            Self::ConstantAcceleration { dimensions, .. } => ("constantAcceleration", dimensions, vec![]),
            Self::IntegratedOrnsteinUhlenbeck { dimensions, damping, drift, .. } => (
                "integratedOrnsteinUhlenbeck",
                dimensions,
                vec![("damping", Some(number(*damping))), ("drift", Some(drift.to_value()))],
            ),
            Self::MeanReverting { dimensions, rate, .. } => {
                ("meanReverting", dimensions, vec![("rate", Some(number(*rate)))])
            }
            Self::EquilibriumRevertingVelocity { dimensions, stiffness, damping, .. } => (
                "equilibriumRevertingVelocity",
                dimensions,
                vec![("stiffness", Some(number(*stiffness))), ("damping", Some(number(*damping)))],
            ),
            Self::Custom { dimensions, drift, diffusion, offset, destination_gain } => (
                "custom",
                dimensions,
                vec![
                    ("drift", Some(Value::from(drift))),
                    ("diffusion", Some(Value::from(diffusion))),
                    ("offset", offset.as_ref().map(Value::numbers)),
                    ("destinationGain", destination_gain.as_ref().map(Value::from)),
                ],
            ),
        };
        let mut entries = vec![("type", Some(Value::text(name))), ("dimensions", Some(number(*dimensions as f64)))];
        entries.push(("noise", self.noise().map(MotionNoise::to_value)));
        entries.extend(others);
        Value::some(entries)
    }
}
