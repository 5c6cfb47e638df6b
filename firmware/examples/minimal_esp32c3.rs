//! A bouncing ball in an Embassy program on an ESP32-C3: all that flat-physics asks of a game. The LED on GPIO8 lights up while
//! the ball is near the floor.
#![no_std]
#![no_main]

use embassy_executor::Spawner;
use embassy_time::{Instant, Timer};
use esp_hal::clock::CpuClock;
use esp_hal::gpio::{Level, Output, OutputConfig};
use esp_hal::timer::systimer::SystemTimer;
use flat_physics::{BodyDef, Effects, Fixed, Only, Pace, Scheduler, Shape, Storage, scalar::px, step, vec2};
use panic_halt as _;
use static_cell::ConstStaticCell;

esp_bootloader_esp_idf::esp_app_desc!();

/// What the game calls for; the rest is neither run nor linked.
const EFFECTS: Only<{ Effects::GRAVITY.and(Effects::BOUNCE).bits() }> = Only;

/// 16 bodies, 32 contacts, in a static: no heap, and nothing large on the stack.
static STORAGE: ConstStaticCell<Storage<Fixed, 16, 32>> = ConstStaticCell::new(Storage::new());

#[esp_rtos::main]
async fn main(_spawner: Spawner) {
    let chip = esp_hal::init(esp_hal::Config::default().with_cpu_clock(CpuClock::max()));
    esp_rtos::start(SystemTimer::new(chip.SYSTIMER).alarm0, chip.FROM_CPU_INTR0);
    let mut led = Output::new(chip.GPIO8, Level::Low, OutputConfig::default());

    let mut world = STORAGE.take().world();
    let floor = Shape::Box { half: vec2(px(64), px(4)) };
    let ball = Shape::Circle { radius: px(6) };
    world.spawn(&BodyDef::fixed(floor, vec2(px(64), px(60)))).expect("there is room for 16");
    let ball = world.spawn(&BodyDef::rigid(ball, vec2(px(64), px(0)))).expect("there is room for 16");

    let mut scheduler = Scheduler::new(Pace::DEFAULT);
    let mut last = Instant::now();
    loop {
        Timer::after_micros(scheduler.until_due_us()).await;
        let now = Instant::now();
        scheduler.elapse((now - last).as_micros());
        last = now;
        for _ in 0..scheduler.take() {
            step(&mut world, EFFECTS);
        }
        let ball = world.body(ball).expect("nobody removes it");
        led.set_level(if ball.position.y > px(40) { Level::High } else { Level::Low });
    }
}
