// A contact in space as a scene in the plane: its surface flat, unrolled, or seen along its mean normal.
#pragma once

#include "figure/door/picture.hpp"

namespace dotyk::figure {

// The surface of the contact at rest, a body in the plane with the values of the contact, and the contact on it, which shows its statuses.
//   flat:                          its own plane
//   straight lines in a direction: (of a cylinder, a tooth) unrolled, `arc` is the length along the profile, from the middle of it;
//                                  a closed cylinder is cut opposite to the mean of its pressure
//   otherwise:                     seen along the mean normal
// Axes keep the names and numbers of the scene's coordinates where the surface is along them. Contacts without facets have no map, nor have closed ones
// that are no cylinders: throws InputError.
bool has_map(const ContactPicture& contact);
ScenePicture contact_map(const ContactPicture& contact);

}  // namespace dotyk::figure
