#pragma once

#include <optional>

#include <beeline/internal/thread_scratch.h>
#include <beeline/model/internal/chain.h>

namespace beeline::internal {

/// The key of an object of which an arm has one.
struct OnlyKey {
  bool operator==(const OnlyKey&) const = default;
};

/// The arms that share an object: copies, those that differ in limits, or in the tool too.
enum class SharedBy { copies, limits, limits_and_tools };

/// The object of type T that this thread has made last, for a list's id and a key, while it is in
/// use. See ThreadScratch.
template <class T>
class LatestOfThread {
 public:
  bool is(std::uint64_t id, const typename T::Key& key) const {
    return latest_->object && latest_->id == id && latest_->key == key;
  }
  void set(std::uint64_t id, const typename T::Key& key, T&& object) {
    latest_->object.reset();  // first, as it may throw
    latest_->id = id;
    latest_->key = key;
    latest_->object.emplace(std::move(object));
  }
  const T& operator*() const { return *latest_->object; }

 private:
  struct Latest {
    std::uint64_t id = 0;
    typename T::Key key{};
    std::optional<T> object;
    bool is_small() const { return true; }
  };
  ThreadScratch<Latest> latest_;
};

/// An object of type T that follows from an arm and a key, made by T::make(arm, key, inputs...)
/// when it is first needed. The arm keeps it and shares it as T::shared_by says. Once its memory is
/// full, each thread keeps its latest one.
template <class T>
class Kept {
 public:
  template <class... Inputs>
  explicit Kept(const Arm& arm, const typename T::Key& key = {}, const Inputs&... inputs) {
    ArmMemory& memory = ArmMemory::of(arm);
    KeptObjects& objects = T::shared_by == SharedBy::copies   ? memory.of_arm
                           : T::shared_by == SharedBy::limits ? *memory.of_geometry
                                                              : *memory.of_links;
    object_ = objects.find<T>(key);
    if (object_ != nullptr) return;
    latest_.emplace();
    if (!latest_->is(objects.id(), key)) {
      T object = T::make(arm, key, inputs...);
      object_ = objects.add<T>(key, object);
      if (object_ == nullptr) latest_->set(objects.id(), key, std::move(object));
    }
    if (object_ == nullptr) {
      object_ = &**latest_;
    } else {
      latest_.reset();
    }
  }

  const T& operator*() const { return *object_; }
  const T* operator->() const { return object_; }

 private:
  const T* object_ = nullptr;
  std::optional<LatestOfThread<T>> latest_;
};

/// An object of type T that follows from an arm and a key and is too large for the arm to keep: the
/// thread keeps the latest one.
template <class T>
class KeptByThread {
 public:
  template <class... Inputs>
  explicit KeptByThread(const Arm& arm, const typename T::Key& key, const Inputs&... inputs) {
    const std::uint64_t id = ArmMemory::of(arm).of_arm.id();
    if (!latest_.is(id, key)) latest_.set(id, key, T::make(arm, key, inputs...));
  }

  const T& operator*() const { return *latest_; }
  const T* operator->() const { return &*latest_; }

 private:
  LatestOfThread<T> latest_;
};

}  // namespace beeline::internal
