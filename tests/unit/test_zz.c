#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <stdio.h>
#include "support/crowded_scene.h"
int main(void){
  double lo=1e300,hi=0;
  for(uint64_t seed=1;seed<200;seed++) for(int v=0;v<3;v++){ sheet_scene sc; crowded_scene(&sc,seed,v==1?crowded_midpoint:crowded_euler,v==2?1e6:0,1); cipc_stepper*s=sc.stepper; real x[300],w[REAL_TERMS]; cipc_energy_terms t; cipc_potential_gradient(s,NULL); cipc_potential_value(s,s->x,&s->contacts,&t,NULL); for(int i=0;i<3*sc.model->node_count;i++)x[i]=s->x[i]; real_potential(s,x,w); double e=(double)fabsl(t.total-w[REAL_TOTAL]); double r=t.noise/e; if(r<lo)lo=r; if(r>hi)hi=r; if(seed==1)printf("%d: in %g mem %g bend %g strain %g barr %g fric %g pen %g noise %g err %g contacts %d fric %d\n",v,t.inertia,t.membrane,t.bending,t.strain_limit,t.barrier,t.friction,t.penalty,t.noise,e,s->contacts.count,s->friction.count); sheet_scene_free(&sc);}
  printf("%g %g\n",lo,hi);
  // bare
  for(int k=0;k<4;k++){ sheet_scene sc; sheet_scene_init(&sc); double a[3]={0.1,0.2,0.3},b[3]={1.1,.2,.3},c[3]={.1,1.2,.3}; cipc_body_description*d=sheet_add_triangle(&sc,"t",a,b,c); d->material.membrane=0; d->material.bending_young=0; double v[3]={k*0.37,-.1,0}; sheet_set_velocity(d,v); sc.gravity[1]=-9.81; sheet_scene_build(&sc); for(int i=0;i<5;i++){ cipc_status st=sheet_try_step(&sc); printf("%d it %d halv %d res %g noise %g %s\n",st,sc.report.newton_iterations,sc.report.line_search_halvings,sc.report.residual,sc.report.incremental.noise,sc.error.what);} sheet_scene_free(&sc);}
}
