//! A reserve of memory, so that a call ends in order when the system refuses more.
//!
//! Most allocations of the core cannot fail in Rust: if the system refuses one, the process ends. This
//! allocator then gives the reserve back to the system, cancels all calls, and tries again. Cancelled
//! calls drop their data and raise `MemoryError`; the next call takes the reserve again.

use std::alloc::{GlobalAlloc, Layout, System};
use std::ptr;
use std::sync::atomic::{AtomicBool, AtomicPtr, AtomicUsize, Ordering};

use numpy::PyReadonlyArray1;
use pyo3::PyErr;
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;

/// Least size: a bound of the allocations of a call until it sees that it is cancelled. Above 32 MiB, because
/// freeing a smaller one would raise the size from which the C library returns memory to the system.
const LEAST: usize = 40 << 20;
/// Copies of a number in memory at once.
const COPIES: usize = 4;
/// Most simultaneous calls that can be cancelled; others run to their end.
const CALLS: usize = 64;
/// Alignment of the reserve: that of its header.
const ALIGN: usize = align_of::<usize>();

/// The reserve, which begins with its size; null once it is used.
static RESERVE: AtomicPtr<usize> = AtomicPtr::new(ptr::null_mut());
/// Number of times that the system has refused memory.
static REFUSALS: AtomicUsize = AtomicUsize::new(0);
/// Marks the place of a flag that is being set.
const BUSY: *mut AtomicBool = ptr::without_provenance_mut(1);
/// The flags that cancel the calls under way.
static CANCELS: [AtomicPtr<AtomicBool>; CALLS] = [const { AtomicPtr::new(ptr::null_mut()) }; CALLS];

#[global_allocator]
static ALLOCATOR: WithReserve = WithReserve;

struct WithReserve;

#[allow(unsafe_code, reason = "an allocator is unsafe to write")]
// SAFETY: all memory comes from the system's allocator, and goes back to it.
unsafe impl GlobalAlloc for WithReserve {
    #[inline]
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller keeps the same contract.
        or_with_reserve(|| unsafe { System.alloc(layout) })
    }

    #[inline]
    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as above.
        or_with_reserve(|| unsafe { System.alloc_zeroed(layout) })
    }

    #[inline]
    unsafe fn realloc(&self, old: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: as above; a block that cannot be moved stays unchanged.
        or_with_reserve(|| unsafe { System.realloc(old, layout, size) })
    }

    #[inline]
    unsafe fn dealloc(&self, old: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(old, layout) }
    }
}

#[inline]
fn or_with_reserve(allocate: impl Fn() -> *mut u8) -> *mut u8 {
    let memory = allocate();
    if memory.is_null() { after_refusal(&allocate) } else { memory }
}

/// Tries again without the reserve. Allocates nothing itself.
#[cold]
fn after_refusal(allocate: &dyn Fn() -> *mut u8) -> *mut u8 {
    REFUSALS.fetch_add(1, Ordering::Relaxed);
    free(RESERVE.swap(ptr::null_mut(), Ordering::AcqRel));
    for place in &CANCELS {
        let flag = place.load(Ordering::Relaxed);
        let is_held = flag.is_null()
            || flag == BUSY
            || place.compare_exchange(flag, BUSY, Ordering::Acquire, Ordering::Relaxed).is_err();
        if is_held {
            continue;
        }
        #[allow(unsafe_code, reason = "flags are on the stacks of other threads")]
        // SAFETY: a call returns only after it has taken its flag out of its place, where it is not now.
        unsafe {
            (*flag).store(true, Ordering::Relaxed);
        }
        place.store(flag, Ordering::Release);
    }
    allocate()
}

fn free(reserve: *mut usize) {
    if reserve.is_null() {
        return;
    }
    #[allow(unsafe_code, reason = "the system's allocator is unsafe to use")]
    // SAFETY: `take` has stored the size of the block that it allocated at its beginning.
    unsafe {
        let layout = Layout::from_size_align_unchecked(*reserve, ALIGN);
        System.dealloc(reserve.cast(), layout);
    }
}

/// Takes a reserve of this size from the system; null if the system refuses it.
fn take(size: usize) -> *mut usize {
    let Ok(layout) = Layout::from_size_align(size, ALIGN) else { return ptr::null_mut() };
    #[allow(unsafe_code, reason = "the system's allocator is unsafe to use")]
    // SAFETY: the size is not zero, and the first bytes are there to hold it.
    unsafe {
        let reserve: *mut usize = System.alloc(layout).cast();
        if !reserve.is_null() {
            *reserve = size;
        }
        reserve
    }
}

pub(crate) fn out_of_memory() -> PyErr {
    PyMemoryError::new_err("out of memory: ask for fewer designs or positions at once")
}

/// Takes the reserve if it is used, or raises `MemoryError`.
pub(crate) fn ensure(_py: Python<'_>) -> PyResult<()> {
    if RESERVE.load(Ordering::Relaxed).is_null() { resize(LEAST) } else { Ok(()) }
}

/// Makes the reserve this large.
fn resize(size: usize) -> PyResult<()> {
    free(RESERVE.swap(ptr::null_mut(), Ordering::AcqRel));
    let reserve = take(size);
    if reserve.is_null() {
        return Err(out_of_memory());
    }
    // If another thread has taken one meanwhile, that one is enough.
    free(RESERVE.swap(reserve, Ordering::AcqRel));
    Ok(())
}

/// A greater reserve, until it is dropped.
pub(crate) struct Room;

impl Drop for Room {
    fn drop(&mut self) {
        // If the system refuses the memory now, the next call requests it again.
        let _ = resize(LEAST);
    }
}

/// A reserve with room for `bytes` besides the least size, for a call that allocates them in few pieces;
/// `MemoryError` if the system refuses it. It takes addresses but no pages, because nothing is written there.
pub(crate) fn room(_py: Python<'_>, bytes: usize) -> PyResult<Option<Room>> {
    if bytes < LEAST / 4 {
        return Ok(None);
    }
    resize(bytes.saturating_add(LEAST))?;
    Ok(Some(Room))
}

/// [`room`] for a call with `numbers` numbers in its arguments and results together: these are copied, and
/// lists that grow take twice their length.
pub(crate) fn room_for(py: Python<'_>, numbers: usize) -> PyResult<Option<Room>> {
    room(py, numbers.saturating_mul(COPIES * size_of::<f64>()))
}

/// A copy of an array, or `MemoryError`.
pub(crate) fn copied(array: &PyReadonlyArray1<'_, f64>) -> PyResult<Vec<f64>> {
    let numbers = array.as_slice()?;
    collected(numbers.len(), numbers.iter().copied())
}

/// A list of `count` items, or `MemoryError`.
pub(crate) fn collected<T>(count: usize, items: impl Iterator<Item = T>) -> PyResult<Vec<T>> {
    let mut list = Vec::new();
    list.try_reserve_exact(count).map_err(|_| out_of_memory())?;
    list.extend(items);
    Ok(list)
}

/// Number of times that the system has refused memory: a call that sees it change ends.
pub(crate) fn refusals() -> usize {
    REFUSALS.load(Ordering::Relaxed)
}

/// `MemoryError` if the system has refused memory since then.
pub(crate) fn check(refusals_before: usize) -> PyResult<()> {
    if refusals() == refusals_before { Ok(()) } else { Err(out_of_memory()) }
}

/// A call that is cancelled when the system refuses memory.
pub(crate) struct Call<'c> {
    place: Option<&'static AtomicPtr<AtomicBool>>,
    cancel: &'c AtomicBool,
    refusals: usize,
}

impl<'c> Call<'c> {
    pub(crate) fn begin(cancel: &'c AtomicBool) -> Self {
        let flag = ptr::from_ref(cancel).cast_mut();
        let is_taken = |place: &&AtomicPtr<AtomicBool>| {
            let null = ptr::null_mut();
            place.compare_exchange(null, flag, Ordering::Release, Ordering::Relaxed).is_ok()
        };
        Self { place: CANCELS.iter().find(is_taken), cancel, refusals: refusals() }
    }

    /// `MemoryError` if it was cancelled for that.
    pub(crate) fn end(self) -> PyResult<()> {
        check(self.refusals)
    }
}

impl Drop for Call<'_> {
    fn drop(&mut self) {
        let flag = ptr::from_ref(self.cancel).cast_mut();
        let Some(place) = self.place else { return };
        // A thread that is cancelling it puts the flag back in a moment.
        while place
            .compare_exchange_weak(flag, ptr::null_mut(), Ordering::Acquire, Ordering::Relaxed)
            .is_err()
        {
            std::hint::spin_loop();
        }
    }
}
