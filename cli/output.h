#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <beeline/certificate/path_deviation.h>
#include <beeline/kinematics/task.h>

#include "arguments.h"

/// How answers are printed: JSON keys in a fixed order, numbers exact; tables rounded for reading.
using OrderedJson = nlohmann::ordered_json;

/// A number for a person: six significant digits, rounding noise shown as 0.
std::string shown(double value);

/// Numbers with commas between, for a person.
std::string shown(const Eigen::VectorXd& values);

/// A pose on one line, in the order that --pose takes: x, y, theta or x, y, z, roll, pitch, yaw.
std::string shown(const beeline::Pose& pose, bool planar, const UnitArgument& unit);

/// Prints a matrix with aligned columns, each row indented and labelled.
void print_matrix(const Eigen::MatrixXd& matrix, const std::vector<std::string>& row_labels);

/// null for a number that JSON does not have.
OrderedJson json_number(double value);
OrderedJson json_vector(const Eigen::VectorXd& values);
OrderedJson json_matrix(const Eigen::MatrixXd& matrix);

/// {matrix, translation, quaternion {qw,qx,qy,qz}} and, for planar arms, planar {x,y,theta}; theta
/// in the caller's unit.
OrderedJson json_pose(const beeline::Pose& pose, bool planar, const UnitArgument& unit);

/// Prints a document on stdout.
void print_json(const OrderedJson& document);

/// Prints a pose for a person.
void print_pose(const beeline::Pose& pose, bool planar, const UnitArgument& unit);
