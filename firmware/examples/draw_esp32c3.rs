//! Twelve balls in a box, drawn through embedded-graphics on an SSD1306 display: SDA on GPIO5, SCL on GPIO6 of an ESP32-C3.
//!
//! Sending a picture takes longer than a step. The scheduler makes up for it: two steps, or three, to a picture, and the
//! balls keep their pace.
#![no_std]
#![no_main]

use embassy_executor::Spawner;
use embassy_time::{Instant, Timer};
use embedded_graphics::pixelcolor::BinaryColor;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{Circle, PrimitiveStyle, Rectangle};
use esp_hal::clock::CpuClock;
use esp_hal::i2c::master::{Config, I2c};
use esp_hal::time::Rate;
use esp_hal::timer::systimer::SystemTimer;
use flat_physics::scalar::px;
use flat_physics::{BodyDef, BodyView, Effects, Fixed, Only, Pace, Scheduler, Shape, Storage, step, vec2};
use panic_halt as _;
use ssd1306::mode::DisplayConfig;
use ssd1306::prelude::{DisplayRotation, DisplaySize128x64};
use ssd1306::{I2CDisplayInterface, Ssd1306};
use static_cell::ConstStaticCell;

esp_bootloader_esp_idf::esp_app_desc!();

const EFFECTS: Only<{ Effects::GRAVITY.and(Effects::BOUNCE).and(Effects::FRICTION).bits() }> = Only;
const BALLS: i16 = 12;

static STORAGE: ConstStaticCell<Storage<Fixed, 16, 64>> = ConstStaticCell::new(Storage::new());

#[esp_rtos::main]
async fn main(_spawner: Spawner) {
    let chip = esp_hal::init(esp_hal::Config::default().with_cpu_clock(CpuClock::max()));
    esp_rtos::start(SystemTimer::new(chip.SYSTIMER).alarm0, chip.FROM_CPU_INTR0);
    let config = Config::default().with_frequency(Rate::from_khz(400));
    let i2c = I2c::new(chip.I2C0, config).expect("400 kHz is in range").with_sda(chip.GPIO5).with_scl(chip.GPIO6);
    let mut display = Ssd1306::new(I2CDisplayInterface::new(i2c), DisplaySize128x64, DisplayRotation::Rotate0)
        .into_buffered_graphics_mode();
    display.init().expect("a display answers");

    let mut world = STORAGE.take().world();
    // Floor and two walls, as thick as nothing can pass.
    for (x, y, half) in [(64, 71, (64, 8)), (-8, 32, (8, 64)), (135, 32, (8, 64))] {
        let half = vec2(px(half.0), px(half.1));
        world.spawn(&BodyDef::fixed(Shape::Box { half }, vec2(px(x), px(y)))).expect("there is room for 16");
    }
    for ball in 0..BALLS {
        let position = vec2(px(10 + 9 * ball), px(5 + ball));
        world.spawn(&BodyDef::rigid(Shape::Circle { radius: px(4) }, position)).expect("there is room for 16");
    }

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
        display.clear(BinaryColor::Off).expect("the picture is in memory");
        for body in world.bodies() {
            draw(&body, &mut display).expect("the picture is in memory");
        }
        // A display that was unplugged is no reason to stop.
        let _ = display.flush();
    }
}

/// Draws a body on any display.
fn draw<D: DrawTarget<Color = BinaryColor>>(body: &BodyView<Fixed>, display: &mut D) -> Result<(), D::Error> {
    let outline = PrimitiveStyle::with_stroke(BinaryColor::On, 1);
    let centre = Point::new(body.position.x.to_num(), body.position.y.to_num());
    match body.shape {
        Shape::Circle { radius } => {
            let diameter = 2 * radius.to_num::<u32>();
            Circle::with_center(centre, diameter).into_styled(outline).draw(display)
        }
        Shape::Box { half } => {
            let size = Size::new(2 * half.x.to_num::<u32>(), 2 * half.y.to_num::<u32>());
            Rectangle::with_center(centre, size).into_styled(outline).draw(display)
        }
    }
}
