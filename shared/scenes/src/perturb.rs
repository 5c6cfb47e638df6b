//! The perturbations that every scene must stand: what holds in one lucky arrangement alone doesn't hold.

use heapless::Vec;

use crate::parameters::{Order, Parameters, Variant};
use crate::scene::Scene;

/// Parameters of a battery of runs.
pub type Battery = Vec<Parameters, 48>;

/// A third of a px.
const PHASE: u16 = 21_845;
/// Far out, and not by a multiple of any cell.
const SHIFT: [i16; 2] = [-7_411, 5_333];
const GAP: u8 = 3;

impl Scene {
    /// Steps of each run in the battery.
    pub fn battery_steps(&self) -> u32 {
        self.long.unwrap_or(self.steps)
    }

    /// The scene as it is written, then in every perturbation that it takes, then in its other sizes.
    pub fn battery(&self) -> Battery {
        let usual = self.defaults;
        let mut runs = Battery::new();
        self.perturb(usual, &mut runs);
        for turned in [
            Variant { mirrored: true, ..Variant::NONE },
            Variant { transposed: true, ..Variant::NONE },
            Variant { phase: PHASE, ..Variant::NONE },
            Variant { shift: SHIFT, ..Variant::NONE },
            Variant { mirrored: true, transposed: true, phase: PHASE, shift: SHIFT, ..Variant::NONE },
        ] {
            self.add(usual, turned, &mut runs);
        }
        for mix in self.takes.mixes {
            self.add(usual, Variant { mix: *mix, ..Variant::NONE }, &mut runs);
        }
        for bodies in self.sizes {
            self.perturb(Parameters { bodies: *bodies, ..usual }, &mut runs);
        }
        runs
    }

    /// Seeds, orders, gravities and gaps: what the outcome may depend on.
    fn perturb(&self, usual: Parameters, runs: &mut Battery) {
        for (seed, order) in [(1, Order::Forward), (2, Order::Reverse), (3, Order::Shuffled), (4, Order::Forward)] {
            self.add(Parameters { seed, order, ..usual }, Variant::NONE, runs);
        }
        for gravity in self.takes.gravities {
            self.add(usual, Variant { gravity: Some(*gravity), ..Variant::NONE }, runs);
        }
        let gapped = Variant { gap: GAP, ..Variant::NONE };
        self.add(usual, gapped, runs);
        if let Some(gravity) = self.takes.gravities.first() {
            self.add(usual, Variant { gravity: Some(*gravity), ..gapped }, runs);
        }
    }

    /// Adds a run, unless the scene doesn't take the variant.
    fn add(&self, parameters: Parameters, variant: Variant, runs: &mut Battery) {
        if let Ok(parameters) = self.vary(parameters, variant) {
            // There is room for four other sizes.
            let _ = runs.push(parameters);
        }
    }
}
