//! Saving and restoring a whole world.

use super::World;
use crate::error::Error;
use crate::scalar::Scalar;

impl<S: Scalar> World<'_, S> {
    /// Becomes a copy of another world, to the last bit: with equal inputs, both go through equal states from then on. For going
    /// back in time, keep a second world as a snapshot; stepped itself, it looks ahead.
    ///
    /// Handles name in the copy what they name in the original. A body that was spawned after a snapshot is gone when that is
    /// restored, and its handle may name another one later.
    ///
    /// ```
    /// use flat_physics::{BodyDef, Effects, Fixed, Shape, Storage, digest, scalar::px, step, vec2};
    ///
    /// let [mut storage, mut other] = [Storage::<Fixed, 4, 8>::new(), Storage::new()];
    /// let (mut world, mut saved) = (storage.world(), other.world());
    /// world.spawn(&BodyDef::rigid(Shape::Circle { radius: px(6) }, vec2(px(0), px(0))))?;
    ///
    /// saved.copy_from(&world)?;
    /// step(&mut world, Effects::ALL);
    /// let later = digest(&world);
    /// world.copy_from(&saved)?;
    /// step(&mut world, Effects::ALL);
    /// assert_eq!(digest(&world), later);
    /// # Ok::<(), flat_physics::Error<Fixed>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Size`] if the two don't have equal capacities, [`Error::Tile`] if the map has no room. Nothing changes then.
    pub fn copy_from(&mut self, other: &World<'_, S>) -> Result<(), Error<S>> {
        let own = (self.capacity(), self.contact_capacity());
        let size = (other.capacity(), other.contact_capacity());
        if own != size {
            return Err(Error::Size { own, other: size });
        }
        // By name, every one of them: a field that is forgotten here doesn't compile.
        let World {
            config,
            gravity,
            bounce_threshold,
            bodies,
            profiles,
            pool,
            before,
            crept,
            layers,
            tiles,
            terrain,
            travel,
            fastest,
            smallest,
            uneven,
            deep,
            bounced,
            strays,
            speed_cap,
            used,
            free,
            count,
            called_for,
            declared,
            declared_level,
            variety,
            declared_variety,
            steps,
            told_at,
            stirred,
            escaped,
            saturations,
        } = other;
        self.tiles.copy_from(tiles)?;
        self.bodies.copy_from_slice(bodies);
        self.profiles.copy_from_slice(profiles);
        self.before.copy_from_slice(before);
        self.crept.copy_from_slice(crept);
        self.pool.copy_from(pool);
        self.layers.copy_from(layers);
        self.terrain = *terrain;
        (self.config, self.gravity, self.bounce_threshold, self.speed_cap) =
            (*config, *gravity, *bounce_threshold, *speed_cap);
        (self.travel, self.fastest, self.smallest, self.uneven) = (*travel, *fastest, *smallest, *uneven);
        (self.deep, self.bounced, self.strays) = (*deep, *bounced, *strays);
        (self.used, self.free, self.count) = (*used, *free, *count);
        (self.called_for, self.declared, self.declared_level) = (*called_for, *declared, *declared_level);
        (self.variety, self.declared_variety) = (*variety, *declared_variety);
        (self.steps, self.told_at, self.stirred) = (*steps, *told_at, *stirred);
        (self.escaped, self.saturations) = (*escaped, *saturations);
        Ok(())
    }
}
