/// The keys of one kind of mapping, which the file that reads it states; a test keeps `schema/scene.schema.json` equal to all.
pub(super) struct Keys {
    pub(super) required: &'static [&'static str],
    pub(super) optional: &'static [&'static str],
}

impl Keys {
    pub(super) fn known(&self) -> impl Iterator<Item = &'static str> + Clone + use<> {
        self.required.iter().chain(self.optional).copied()
    }
}
