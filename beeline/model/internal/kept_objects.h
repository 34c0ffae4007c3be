#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace beeline::internal {

/// The memory that a vector of plain data has allocated, bytes.
template <class T>
std::size_t heap_bytes(const std::vector<T>& numbers) {
  return numbers.capacity() * sizeof(T);
}

/// Objects of any type that follow from an arm, by type and key. Each is added when it is first
/// needed and kept as long as the list. Threads search and add at the same time and never wait.
///
/// A type T has a type T::Key, with ==, and a function heap_bytes(). It must not contain a copy of
/// the arm, which would keep the list alive.
class KeptObjects {
 public:
  KeptObjects(std::size_t max_bytes, std::size_t bytes) : max_bytes_(max_bytes), bytes_(bytes) {}
  KeptObjects(const KeptObjects&) = delete;
  KeptObjects& operator=(const KeptObjects&) = delete;
  ~KeptObjects() {
    for (Entry* entry = first_.load(); entry != nullptr;) {
      Entry* const next = entry->next;
      entry->destroy(entry);
      entry = next;
    }
  }

  /// A number that no other list of the process has or had.
  std::uint64_t id() const { return id_; }
  std::size_t bytes() const { return bytes_; }

  /// Returns the object, or null.
  template <class T>
  const T* find(const typename T::Key& key) const {
    return find_from<T>(first_.load(std::memory_order_acquire), key);
  }

  /// Adds the object, which is moved, and returns it. Returns the other one if a thread has added
  /// one of this key, and null if the list is full.
  template <class T>
  const T* add(const typename T::Key& key, T& object) {
    const std::size_t size = sizeof(EntryOf<T>) + object.heap_bytes();
    if (bytes_.fetch_add(size) + size > max_bytes_) {
      bytes_.fetch_sub(size);
      return nullptr;
    }
    auto entry = std::make_unique<EntryOf<T>>(key, std::move(object));
    Entry* first = first_.load(std::memory_order_acquire);
    do {
      if (const T* const other = find_from<T>(first, key)) {
        bytes_.fetch_sub(size);
        return other;
      }
      entry->next = first;
    } while (!first_.compare_exchange_weak(first, entry.get(), std::memory_order_acq_rel,
                                           std::memory_order_acquire));
    return &entry.release()->object;
  }

 private:
  struct Entry {
    const void* type;
    void (*destroy)(Entry*);
    Entry* next = nullptr;
  };
  template <class T>
  struct EntryOf : Entry {
    EntryOf(const typename T::Key& its_key, T&& its_object)
        : Entry{&type_of<T>, [](Entry* entry) { delete static_cast<EntryOf*>(entry); }},
          key(its_key),
          object(std::move(its_object)) {}
    typename T::Key key;
    T object;
  };
  /// Its address is the type.
  template <class T>
  static inline char type_of = 0;

  template <class T>
  static const T* find_from(const Entry* entry, const typename T::Key& key) {
    for (; entry != nullptr; entry = entry->next) {
      if (entry->type != &type_of<T>) continue;
      const auto* const found = static_cast<const EntryOf<T>*>(entry);
      if (found->key == key) return &found->object;
    }
    return nullptr;
  }

  static std::uint64_t next_id() {
    static std::atomic<std::uint64_t> last = 0;
    return ++last;
  }

  const std::uint64_t id_ = next_id();
  const std::size_t max_bytes_;
  std::atomic<std::size_t> bytes_;
  std::atomic<Entry*> first_ = nullptr;
};

}  // namespace beeline::internal
