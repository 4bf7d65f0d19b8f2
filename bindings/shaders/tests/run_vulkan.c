/* SPDX-License-Identifier: MIT
 *
 * SPIR-V as compute shaders of Vulkan: what glslangValidator makes of the texts in GLSL 4.50, and of those in HLSL.
 */
#include "judge.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vulkan.h>

static const char *const names[] = {"Vulkan, GLSL 4.50 by glslang", "Vulkan, HLSL by glslang"};
static const char *const suffixes[] = {".spv", ".hlsl.spv"};

static VkInstance instance;
static VkPhysicalDevice physical;
static VkDevice gpu;
static VkQueue queue;
static VkCommandPool commands;
static VkDescriptorSetLayout set_layout;
static VkPipelineLayout layout;
static VkDescriptorPool pool;
static VkDescriptorSet set;
static VkBuffer buffers[2];
static VkDeviceMemory memories[2];
static float *mapped[2];
static size_t point_count;

const char *device_name(int device)
{
    return device < 2 ? names[device] : NULL;
}

int device_has_all_floats(int device)
{
    (void)device;
    return 0;
}

static int open_device(void)
{
    VkApplicationInfo application = {VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.apiVersion = VK_API_VERSION_1_1;
    VkInstanceCreateInfo instance_info = {VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    instance_info.pApplicationInfo = &application;
    uint32_t one = 1;
    if (vkCreateInstance(&instance_info, NULL, &instance) != VK_SUCCESS ||
        vkEnumeratePhysicalDevices(instance, &one, &physical) < 0 || one == 0)
    {
        return 0;
    }
    /* the first family, which on every device can compute */
    float priority = 1.0f;
    VkDeviceQueueCreateInfo queue_info = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;
    VkDeviceCreateInfo device_info = {VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    device_info.queueCreateInfoCount = 1;
    device_info.pQueueCreateInfos = &queue_info;
    if (vkCreateDevice(physical, &device_info, NULL, &gpu) != VK_SUCCESS)
    {
        return 0;
    }
    vkGetDeviceQueue(gpu, 0, 0, &queue);
    VkCommandPoolCreateInfo pool_info = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    return vkCreateCommandPool(gpu, &pool_info, NULL, &commands) == VK_SUCCESS;
}

/* Of memory that the host sees. */
static int make_buffer(int which, VkDeviceSize size)
{
    VkBufferCreateInfo info = {VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = size;
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    if (vkCreateBuffer(gpu, &info, NULL, &buffers[which]) != VK_SUCCESS)
    {
        return 0;
    }
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(gpu, buffers[which], &needs);
    VkPhysicalDeviceMemoryProperties has;
    vkGetPhysicalDeviceMemoryProperties(physical, &has);
    VkMemoryPropertyFlags wanted =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkMemoryAllocateInfo allocation = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocation.allocationSize = needs.size;
    while (allocation.memoryTypeIndex < has.memoryTypeCount &&
           ((needs.memoryTypeBits >> allocation.memoryTypeIndex & 1u) == 0 ||
            (has.memoryTypes[allocation.memoryTypeIndex].propertyFlags & wanted) != wanted))
    {
        allocation.memoryTypeIndex++;
    }
    return vkAllocateMemory(gpu, &allocation, NULL, &memories[which]) == VK_SUCCESS &&
           vkBindBufferMemory(gpu, buffers[which], memories[which], 0) == VK_SUCCESS &&
           vkMapMemory(gpu, memories[which], 0, size, 0, (void **)&mapped[which]) == VK_SUCCESS;
}

static int make_layout(void)
{
    VkDescriptorSetLayoutBinding bindings[2];
    memset(bindings, 0, sizeof bindings);
    for (uint32_t k = 0; k < 2; k++)
    {
        bindings[k].binding = k;
        bindings[k].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        bindings[k].descriptorCount = 1;
        bindings[k].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    }
    VkDescriptorSetLayoutCreateInfo set_info = {
        VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    set_info.bindingCount = 2;
    set_info.pBindings = bindings;
    if (vkCreateDescriptorSetLayout(gpu, &set_info, NULL, &set_layout) != VK_SUCCESS)
    {
        return 0;
    }
    VkPipelineLayoutCreateInfo layout_info = {VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout_info.setLayoutCount = 1;
    layout_info.pSetLayouts = &set_layout;
    VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2};
    VkDescriptorPoolCreateInfo pool_info = {VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool_info.maxSets = 1;
    pool_info.poolSizeCount = 1;
    pool_info.pPoolSizes = &size;
    return vkCreatePipelineLayout(gpu, &layout_info, NULL, &layout) == VK_SUCCESS &&
           vkCreateDescriptorPool(gpu, &pool_info, NULL, &pool) == VK_SUCCESS;
}

static int make_set(void)
{
    VkDescriptorSetAllocateInfo info = {VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &set_layout;
    if (vkAllocateDescriptorSets(gpu, &info, &set) != VK_SUCCESS)
    {
        return 0;
    }
    for (uint32_t k = 0; k < 2; k++)
    {
        VkDescriptorBufferInfo whole = {buffers[k], 0, VK_WHOLE_SIZE};
        VkWriteDescriptorSet write = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        write.dstSet = set;
        write.dstBinding = k;
        write.descriptorCount = 1;
        write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        write.pBufferInfo = &whole;
        vkUpdateDescriptorSets(gpu, 1, &write, 0, NULL);
    }
    return 1;
}

int device_open(int device, size_t count, const float *points)
{
    point_count = count;
    size_t size = count * POINT_FLOATS * sizeof(float);
    if (!open_device() || !make_buffer(0, size) ||
        !make_buffer(1, count * RESULT_FLOATS * sizeof(float)) || !make_layout() || !make_set())
    {
        fprintf(stderr, "no device of Vulkan\n");
        return 0;
    }
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    fprintf(stderr, "%s: %s\n", names[device], properties.deviceName);
    memcpy(mapped[0], points, size);
    return 1;
}

static VkPipeline make_pipeline(const char *text, size_t size)
{
    VkShaderModuleCreateInfo module_info = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    module_info.codeSize = size;
    module_info.pCode = (const uint32_t *)(const void *)text;
    VkComputePipelineCreateInfo info = {VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.pName = "main";
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    if (vkCreateShaderModule(gpu, &module_info, NULL, &info.stage.module) == VK_SUCCESS)
    {
        vkCreateComputePipelines(gpu, VK_NULL_HANDLE, 1, &info, NULL, &pipeline);
        vkDestroyShaderModule(gpu, info.stage.module, NULL);
    }
    return pipeline;
}

int device_run(int device, const char *folder, int program, float *results)
{
    size_t size;
    char *text = read_text(folder, program, suffixes[device], &size);
    VkPipeline pipeline = make_pipeline(text, size);
    free(text);
    VkCommandBufferAllocateInfo allocation = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocation.commandPool = commands;
    allocation.commandBufferCount = 1;
    VkCommandBuffer buffer;
    if (pipeline == VK_NULL_HANDLE ||
        vkAllocateCommandBuffers(gpu, &allocation, &buffer) != VK_SUCCESS)
    {
        return 0;
    }
    VkCommandBufferBeginInfo begin = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    vkBeginCommandBuffer(buffer, &begin);
    vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdBindDescriptorSets(buffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, NULL);
    vkCmdDispatch(buffer, (uint32_t)(point_count / 64), 1, 1);
    vkEndCommandBuffer(buffer);
    VkSubmitInfo submit = {VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &buffer;
    int is_good = vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE) == VK_SUCCESS &&
                  vkQueueWaitIdle(queue) == VK_SUCCESS;
    memcpy(results, mapped[1], point_count * RESULT_FLOATS * sizeof(float));
    vkFreeCommandBuffers(gpu, commands, 1, &buffer);
    vkDestroyPipeline(gpu, pipeline, NULL);
    return is_good;
}

void device_close(int device)
{
    (void)device;
    for (int k = 0; k < 2; k++)
    {
        vkDestroyBuffer(gpu, buffers[k], NULL);
        vkFreeMemory(gpu, memories[k], NULL);
    }
    vkDestroyDescriptorPool(gpu, pool, NULL);
    vkDestroyPipelineLayout(gpu, layout, NULL);
    vkDestroyDescriptorSetLayout(gpu, set_layout, NULL);
    vkDestroyCommandPool(gpu, commands, NULL);
    vkDestroyDevice(gpu, NULL);
    vkDestroyInstance(instance, NULL);
}
