//! The page that lists the scenes is what the catalogue says.

use std::fmt::Write;
use std::{env, fs};

use flat_rig::check::Words;
use flat_rig::input::Inputs;
use flat_scenes::{Demo, Player, SCENES, Scene};

const HEAD: &str = "\
# Scenes

Built in, by name, on every board: `cargo rig run NAME` runs one on the mock and checks what it promises; `--target mock,qemu` shows
that QEMU ends in the same bits. `--perturbed` runs it in every arrangement that it takes. Each is a file, or shares one with its
family, in [`shared/scenes/src/catalogue`](../shared/scenes/src/catalogue).

A body goes by its number in the scene, lengths are in px, speeds in px/s, y points down. Steps are 1/60 s. What is promised is what
holds at level Grounded in fixed point, and in most scenes in every way to compute; what is known to fall short of its bar in any
of them, or in any arrangement, is named.

";

const PLAYERS: &str = "
## Scenes with a player

They play by themselves unless somebody else does, with `--input` and `left`, `right`, `jump`, `down`, each for a number of steps:
`cargo rig run platformer --input 'right:60 jump+right:20 idle:30'`, or `--input @FILE`. The promises that don't hang on what is
played are then checked. What they play by themselves:

";

const FOOT: &str = "\n<!-- Written by `FLAT_BLESS=1 cargo test -p flat-rig --test scenes_page`. -->\n";

fn promises(scene: &Scene) -> String {
    let promises = scene.promises(&scene.defaults, Player::Demo);
    let short = scene
        .shortfalls
        .iter()
        .map(|short| format!("*known to fall short: {}, {:.3} at worst*", short.check, short.figure));
    promises.iter().map(|promise| Words(promise).to_string()).chain(short).collect::<Vec<_>>().join("<br>")
}

fn page() -> String {
    let mut page = HEAD.to_owned();
    page += "| scene | what it shows | effects | bodies | steps | promises |\n|---|---|---|---:|---:|---|\n";
    for scene in SCENES {
        let Scene { name, purpose, effects, defaults, steps, .. } = scene;
        let bodies = defaults.bodies;
        let _ = writeln!(page, "| `{name}` | {purpose} | {effects} | {bodies} | {steps} | {} |", promises(scene));
    }
    page += PLAYERS;
    for (name, Demo { holds, .. }) in SCENES.iter().filter_map(|scene| Some((scene.name, scene.demo?))) {
        let _ = writeln!(page, "- `{name}`: `{}`", Inputs::new(holds));
    }
    page + FOOT
}

#[test]
fn the_page_lists_every_scene_as_it_is() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/scenes.md");
    let page = page();
    if env::var_os("FLAT_BLESS").is_some() {
        fs::write(path, &page).unwrap();
    }
    let known = fs::read_to_string(path).unwrap_or_default();
    let differs = known.lines().zip(page.lines()).find(|(known, is)| known != is);
    assert!(known == page, "FLAT_BLESS=1 cargo test -p flat-rig --test scenes_page writes the page anew: {differs:#?}");
}
