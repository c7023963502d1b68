//! Whatever a scene file holds, it is read or refused in one line.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Err(error) = elbowroom::scene::parse(text, "s.yaml") {
        assert_eq!(error.to_string().lines().count(), 1, "{error}");
    }
});
