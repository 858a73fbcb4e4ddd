// error: no matching (member )?function for call to|constraints not satisfied
// A method that wants another pass.
#include "recorders.h"

struct Recorder {
  void meshes(recorders::MeshesPass& pass) { pass.draw(3); }
#ifdef RG_RIGHT
  void own_pipelines(recorders::OwnPipelinesPass& pass) { pass.draw(3); }
#else
  void own_pipelines(recorders::MeshesPass& pass) { pass.draw(3); }
#endif
};

rg::Status one_frame(recorders::Frame& frame, const recorders::Imports& imports, const recorders::EngineSets& sets, Recorder& recorder) {
  return frame.execute(imports, recorders::Params{}, sets, recorders::Updates{}, recorders::Conditions{}, recorder);
}
