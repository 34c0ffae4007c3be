#include "dispatcher.h"

#include <chrono>
#include <cstdint>

#include <mpi.h>

namespace {

constexpr int request_tag = 1, unit_tag = 2;
constexpr std::int64_t nothing_left = -1;

void sleep_briefly() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

/// MPI_Wait() without keeping a core busy.
void wait_for(MPI_Request& request) {
  for (int done = 0; done == 0;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done == 0) sleep_briefly();
  }
}

}  // namespace

Dispatcher::Dispatcher(const std::vector<Eigen::Index>& units)
    : left_(units.begin(), units.end()),
      all_(units.size()),
      thread_([this] { answer_requests(); }) {}

Dispatcher::~Dispatcher() { thread_.join(); }

std::optional<Eigen::Index> Dispatcher::next() {
  const std::lock_guard lock(taking_);
  if (left_.empty()) return std::nullopt;
  const Eigen::Index unit = left_.front();
  left_.pop_front();
  return unit;
}

double Dispatcher::fraction() {
  const std::lock_guard lock(taking_);
  return all_ == 0 ? 1 : 1 - static_cast<double>(left_.size()) / static_cast<double>(all_);
}

void Dispatcher::answer_requests() {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  for (int ended = 0; ended < ranks - 1;) {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, request_tag, MPI_COMM_WORLD, &there, &status);
    if (there == 0) {
      sleep_briefly();
      continue;
    }
    MPI_Recv(nullptr, 0, MPI_BYTE, status.MPI_SOURCE, request_tag, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    const std::int64_t unit = next().value_or(nothing_left);
    MPI_Send(&unit, 1, MPI_INT64_T, status.MPI_SOURCE, unit_tag, MPI_COMM_WORLD);
    ended += unit == nothing_left;
  }
}

std::optional<Eigen::Index> ask_for_unit() {
  MPI_Send(nullptr, 0, MPI_BYTE, 0, request_tag, MPI_COMM_WORLD);
  std::int64_t unit = nothing_left;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Irecv(&unit, 1, MPI_INT64_T, 0, unit_tag, MPI_COMM_WORLD, &request);
  wait_for(request);
  if (unit == nothing_left) return std::nullopt;
  return unit;
}

int largest_of_all(int value) {
  int largest = value;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(&value, &largest, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD, &request);
  wait_for(request);
  return largest;
}
