//! Departures from a scene as it is written: the options for them.

use clap::{Args, ValueEnum};
use flat_scenes::{Mix, Order, Parameters, Scene, Variant};
use flat_wire::message;

/// What a scene may be varied by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Args)]
pub struct VariantArgs {
    /// Left and right change places
    #[arg(long)]
    mirror: bool,

    /// x and y change places; gravity then pulls to the right
    #[arg(long)]
    transpose: bool,

    /// Shifts everything by so many 1/65536 px
    #[arg(long, value_name = "N", default_value_t, hide_default_value = true)]
    phase: u16,

    /// Shifts everything by whole px
    #[arg(long, value_name = "X,Y", value_parser = shift, allow_hyphen_values = true)]
    shift: Option<[i16; 2]>,

    /// Strength of gravity, px/s2 [default: the scene's]
    #[arg(long, value_name = "G", allow_hyphen_values = true)]
    gravity: Option<i16>,

    /// Space between stacked bodies at the start, px
    #[arg(long, value_name = "PX", default_value_t, hide_default_value = true)]
    gap: u8,

    /// What varies from body to body
    #[arg(long, value_enum)]
    mix: Option<MixArg>,
}

/// `--mix`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MixArg {
    /// Sizes.
    Sizes,
    /// Masses.
    Masses,
    /// Circles among boxes, boxes among circles.
    Shapes,
}

fn shift(text: &str) -> Result<[i16; 2], String> {
    let wrong = "must be X,Y: two whole numbers, -32768 to 32767";
    let (x, y) = text.split_once(',').ok_or(wrong)?;
    Ok([x.trim().parse().map_err(|_| wrong)?, y.trim().parse().map_err(|_| wrong)?])
}

impl From<VariantArgs> for Variant {
    fn from(arguments: VariantArgs) -> Self {
        let VariantArgs { mirror, transpose, phase, shift, gravity, gap, mix } = arguments;
        let mix = match mix {
            None => Mix::None,
            Some(MixArg::Sizes) => Mix::Sizes,
            Some(MixArg::Masses) => Mix::Masses,
            Some(MixArg::Shapes) => Mix::Shapes,
        };
        Self { mirrored: mirror, transposed: transpose, phase, shift: shift.unwrap_or_default(), gravity, gap, mix }
    }
}

/// The same for a device.
pub fn requested(variant: &Variant) -> message::Variant {
    let Variant { mirrored, transposed, phase, shift, gravity, gap, mix } = *variant;
    let mix = match mix {
        Mix::None => message::Mix::None,
        Mix::Sizes => message::Mix::Sizes,
        Mix::Masses => message::Mix::Masses,
        Mix::Shapes => message::Mix::Shapes,
    };
    message::Variant { mirrored, transposed, phase, shift, gravity, gap, mix }
}

/// The options that ask for these parameters, without those that are the scene's defaults anyway.
pub fn options(scene: &Scene, parameters: &Parameters) -> Vec<String> {
    let Parameters { bodies, seed, order, variant } = *parameters;
    let mut words = Vec::new();
    let mut option = |asked: bool, name: &str, value: &dyn ToString| {
        if asked {
            words.push(format!("--{name}"));
            words.extend(Some(value.to_string()).filter(|value| !value.is_empty()));
        }
    };
    option(bodies != scene.defaults.bodies, "bodies", &bodies);
    option(seed != scene.defaults.seed, "seed", &seed);
    option(order != Order::Forward, "order", &format!("{order:?}").to_lowercase());
    option(variant.mirrored, "mirror", &"");
    option(variant.transposed, "transpose", &"");
    option(variant.phase != 0, "phase", &variant.phase);
    let [x, y] = variant.shift;
    option(variant.shift != [0, 0], "shift", &format!("{x},{y}"));
    option(variant.gravity.is_some(), "gravity", &variant.gravity.unwrap_or_default());
    option(variant.gap != 0, "gap", &variant.gap);
    option(variant.mix != Mix::None, "mix", &format!("{:?}", variant.mix).to_lowercase());
    words
}
