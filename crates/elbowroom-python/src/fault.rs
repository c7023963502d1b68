//! Panics, which are faults of ours: kept for the error they become instead of printed.

use std::any::Any;
use std::panic::{PanicHookInfo, set_hook};
use std::sync::Mutex;

/// Where the last one was.
static PLACE: Mutex<Option<String>> = Mutex::new(None);

/// From now on panics in this library are remembered and not printed.
pub(crate) fn keep() {
    set_hook(Box::new(|panic: &PanicHookInfo<'_>| {
        if let (Ok(mut place), Some(at)) = (PLACE.lock(), panic.location()) {
            *place = Some(format!("{}:{}", at.file(), at.line()));
        }
    }));
}

/// What a panic said, and where.
pub(crate) fn in_words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(ToString::to_string);
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    let place = PLACE.lock().ok().and_then(|mut place| place.take());
    let [text, place] = [text, place].map(|part| part.unwrap_or_else(|| "unknown".to_owned()));
    format!("{text} ({place})")
}
