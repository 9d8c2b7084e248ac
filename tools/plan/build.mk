# `skyvert plan`: what of the library a scene needs. tools/skyvert/plan.c is the command; the rest is here and linked in.
PLAN_OBJ  := $(addprefix $(B)/tools/plan/,scene.o sample.o kind.o light.o error.o cost.o search.o report.o) $(B)/tools/trade/metric.o
PORT_OBJ  += $(PLAN_OBJ)
# What of the command the programs here use.
PLAN_BASE := $(addprefix $(B)/tools/skyvert/,errors.o options.o output.o progress.o csv.o ini.o ini_document.o table_file.o)
PLAN_LINK  = $(CC) $(TOOL_FLAGS) -pthread $^ $$($(PKG_CONFIG) --libs inih) -lm -o $@
DEPS_RUN  += libinih-dev

$(B)/tools/plan/%.o: tools/plan/%.c $(wildcard tools/plan/*.h tools/skyvert/*.h tools/reference/*.h tools/trade/*.h) $(HEADERS) tools/plan/build.mk
	@mkdir -p $(@D)
	$(CC) $(TOOL_FLAGS) $(CORE_EXTRA) -I. -Itools/reference -c $< -o $@

PLAN_SAMPLE := $(addprefix $(B)/tools/plan/,scene.o sample.o)
$(B)/plan-truth: $(B)/tools/plan/truth.o $(PLAN_SAMPLE) $(PLAN_BASE) $(B)/tools/reference/read_ini.o $(B)/libreference.a $(LIB)
	$(PLAN_LINK)
$(B)/plan-floor: $(B)/tools/plan/floor.o $(B)/tools/plan/light.o $(B)/tools/plan/kind.o $(PLAN_SAMPLE) $(PLAN_BASE) $(LIB)
	$(PLAN_LINK)

PLAN_DATA   := tools/reference/data
PLAN_TRUTHS := tools/bench/br16.ini $(PLAN_DATA)/br16.csv tools/bench/br17o.ini $(PLAN_DATA)/br17o.csv \
               $(PLAN_DATA)/thin.ini $(PLAN_DATA)/thin.csv $(PLAN_DATA)/thick.ini $(PLAN_DATA)/thick.csv \
               $(PLAN_DATA)/mars.ini $(PLAN_DATA)/mars.csv $(PLAN_DATA)/coarse.ini $(PLAN_DATA)/coarse.csv
.PHONY: plan-truth plan-floor plan-costs
plan-costs: ## count instructions for the planner again (tools/plan/costs_data.h); minutes
	@B=$(B) MAKE="$(MAKE)" $(BASH) tools/plan/costs.sh
plan-truth: $(B)/plan-truth ## trace the planner's pool of rays again (tools/plan/pool.csv); many minutes
	$(B)/plan-truth pool > $(B)/pool.csv && mv $(B)/pool.csv tools/plan/pool.csv
plan-floor: $(B)/plan-floor ## what the library is off from that pool (tools/plan/floor_data.h); seconds
	$(B)/plan-floor tools/plan/pool.csv $(PLAN_TRUTHS) > $(B)/floor_data.h && mv $(B)/floor_data.h tools/plan/floor_data.h
