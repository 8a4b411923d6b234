//! An allocator that counts, while it is asked to.

use mimalloc::MiMalloc;
use std::alloc::{GlobalAlloc, Layout};
use std::sync::atomic::{AtomicBool, AtomicIsize, Ordering::Relaxed};

/// The allocator of `dsr` itself. While nobody counts, it costs one predicted branch more.
struct Counting(MiMalloc);

#[global_allocator]
static ALLOCATOR: Counting = Counting(MiMalloc);
static COUNTS: AtomicBool = AtomicBool::new(false);
static BYTES: AtomicIsize = AtomicIsize::new(0);

/// The bytes that are still allocated of those that `make` has asked for, with what it has made.
///
/// Bytes as asked for: what an allocator adds to round them up is not in them. All threads are counted, and only one
/// at a time may measure.
pub fn bytes_of<T>(make: impl FnOnce() -> T) -> (isize, T) {
    BYTES.store(0, Relaxed);
    COUNTS.store(true, Relaxed);
    let result = make();
    COUNTS.store(false, Relaxed);
    (BYTES.load(Relaxed), result)
}

fn count(bytes: usize, sign: isize) {
    if COUNTS.load(Relaxed) {
        BYTES.fetch_add(sign * bytes.cast_signed(), Relaxed);
    }
}

// The only unsafe code of the repository: Rust has no other way to see allocations. Each function hands its arguments to
// MiMalloc as they are, whose contract is the same, and touches nothing but two atomics.
#[allow(unsafe_code, reason = "an allocator cannot be written without")]
// SAFETY: MiMalloc is a correct allocator, and every call is passed on to it unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size(), 1);
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { self.0.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(layout.size(), 1);
        // SAFETY: the caller keeps the contract of `alloc_zeroed`.
        unsafe { self.0.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        count(layout.size(), -1);
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { self.0.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(layout.size(), -1);
        count(size, 1);
        // SAFETY: the caller keeps the contract of `realloc`.
        unsafe { self.0.realloc(memory, layout, size) }
    }
}
