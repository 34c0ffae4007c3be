#pragma once

#include <memory>
#include <utility>

namespace beeline::internal {

/// An object of type T that a thread uses again for its next computation, so that the memory of its
/// members is allocated once. Its values are those that the last user left. While one is in use, a
/// second one of the same type is another object. The thread keeps it until it ends, if
/// T::is_small().
template <class T>
class ThreadScratch {
 public:
  ThreadScratch() : object_(std::move(kept())) {
    if (!object_) object_ = std::make_unique<T>();
  }
  ~ThreadScratch() {
    if (object_->is_small()) kept() = std::move(object_);
  }
  ThreadScratch(const ThreadScratch&) = delete;
  ThreadScratch& operator=(const ThreadScratch&) = delete;

  T& operator*() { return *object_; }
  T* operator->() { return object_.get(); }
  const T* operator->() const { return object_.get(); }

 private:
  static std::unique_ptr<T>& kept() {
    static thread_local std::unique_ptr<T> object;
    return object;
  }

  std::unique_ptr<T> object_;
};

}  // namespace beeline::internal
