#include <cstdio>
#include <chrono>
#include <cstdlib>
#include <string>
#include "libindet/polytope/sparse_decision.h"
#include "tests/support/extremes.h"
#include "tests/support/zoo.h"
using namespace indet;
static int same=0, undec=0, wrong=0, proven[3]={0,0,0};
static void check(const char* name, const Packing& p){
  SparseDecision d = decide_sparsely(p);
  ForcePolytope f; bool failed=false;
  try { f = find_force_polytope(p);} catch(const std::exception& e){ failed=true; printf("%s: LP fails: %s; sparse decided %d %s\n",name,e.what(),d.decided,to_string(d.status)); return;}
  if(!d.decided){++undec; printf("UNDECIDED %s: dense %s dim %d doubtful %d margin %.2e steps %zu\n",name,to_string(f.status),f.dim,f.doubtful,d.margin,d.steps.size());return;}
  if(d.status!=f.status||d.dim!=f.dim){++wrong; printf("WRONG %s: dense %s %d doubtful %d, sparse %s %d proof %d margin %.2e\n",name,to_string(f.status),f.dim,f.doubtful,to_string(d.status),d.dim,(int)d.proof,d.margin);return;}
  ++same; ++proven[(int)d.proof];
  if((int)d.proof==0) printf("unproven %s %s dim %d doubtful %d margin %.2e\n",name,to_string(d.status),d.dim,f.doubtful,d.margin);
}
int main(int argc,char**argv){
  std::string only = argc>1?argv[1]:"";
  auto go=[&](const std::string& n,const Packing& p){ if(only.empty()||n.find(only)!=std::string::npos) check(n.c_str(),p);};
  std::vector<std::pair<std::string,Packing>> z={{"wedge.4",zoo::wedge(0.4, 0.3)},{"wedge1.4", zoo::wedge(1.4, 0.3)},{"wedge0",zoo::wedge(0,0.3)},{"floor", zoo::disk_on_floor(0.3)},{"incline", zoo::disk_on_incline(0.1, 1)},
        {"pyr1",zoo::pyramid(0.8, 0.1, 1)},{"pyr2", zoo::pyramid(0.8, 1, 0.1)},{"pyr3", zoo::pyramid(0.8, 1, 1)},
        {"column",zoo::column(9, 0.4, 0.3)},{"fcol", zoo::frictionless_column(5, 0.4)},{"pinched", zoo::pinched_disk(0.3)},{"cbw",zoo::column_between_walls(6,0.3)},
        {"tw",zoo::two_wedges(0.4, 0.3, 1.4, 0.3)},{"corner1", zoo::corner(0.4, 1)},{"corner.9", zoo::corner(0.4, 0.9)},{"corner11",zoo::corner(1,1)},
        {"wac",zoo::wedge_and_corner(0.4, 0.3)},{"wald", zoo::wedge_and_loose_disk(0.4, 0.3, 1)},{"wald0", zoo::wedge_and_loose_disk(0.4, 0.3, 0)},{"lp.6", zoo::lattice_pile(5, 0.6)},
        {"lp.3",zoo::lattice_pile(5, 0.3)},{"spun1",zoo::spun_wedge(0.6,0.3,zoo::spun_wedge_critical_torque(0.6,0.3))},{"spun.9",zoo::spun_wedge(0.6,0.3,0.9*zoo::spun_wedge_critical_torque(0.6,0.3))},{"spun1.1",zoo::spun_wedge(0.6,0.3,1.1*zoo::spun_wedge_critical_torque(0.6,0.3))}};
  for(auto&[n,p]:z) go("zoo:"+n,p);
  printf("zoo: same %d undecided %d wrong %d proven none %d float %d exact %d\n",same,undec,wrong,proven[0],proven[1],proven[2]);
  for (std::uint64_t seed = 0; seed < 200; ++seed) go("pile:"+std::to_string(seed)+".",zoo::random_pile(seed, 3 + static_cast<int>(seed % 20), seed % 2 == 0 ? -1 : 0.4));
  printf("+piles: same %d undecided %d wrong %d proven none %d float %d exact %d\n",same,undec,wrong,proven[0],proven[1],proven[2]);
  for(auto& s: extremes::fixed_scenes()) go("ext:"+s.kind+"/"+s.name,s.packing);
  printf("+ext: same %d undecided %d wrong %d proven none %d float %d exact %d\n",same,undec,wrong,proven[0],proven[1],proven[2]);
}
